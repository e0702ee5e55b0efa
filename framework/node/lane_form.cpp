// SPDX-License-Identifier: MIT
#include "lane_form.hpp"

#include <algorithm>
#include <cstdlib>

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
    const auto most = wanted != nullptr ? std::strtoul (wanted, nullptr, 10) : widestLanes();
    return std::clamp<std::size_t> (most, 1, widestLanes());
}

}   // namespace tactus
