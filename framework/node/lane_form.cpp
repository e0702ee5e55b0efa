// SPDX-License-Identifier: MIT
#include "lane_form.hpp"

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

}   // namespace tactus
