// SPDX-License-Identifier: MIT
#include "lane_form.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace tactus
{

std::size_t widestLanes() noexcept
{
#if defined(__x86_64__) || defined(__i386__)
    static const std::size_t widest = __builtin_cpu_supports ("avx512f") ? 8 : __builtin_cpu_supports ("avx2") ? 4
                                                                                                               : 2;
    return widest;
#else
    return 2;
#endif
}

std::size_t usualLanes() noexcept
{
    const auto* wanted = std::getenv ("TACTUS_LANES");
    if (wanted == nullptr) return widestLanes();
    const auto* end = wanted + std::strlen (wanted);
    std::size_t most = 0;
    const auto [rest, error] = std::from_chars (wanted, end, most);
    if (error != std::errc {} || rest != end) return widestLanes();   // not a number: the same as not set
    return std::clamp<std::size_t> (most, 1, widestLanes());
}

}   // namespace tactus
