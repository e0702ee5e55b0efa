// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_number.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double pixels_over_range = 200.0;
}

bool isLogarithmic (const PortSheet& sheet) noexcept
{
    const auto& usual = sheet.limits.usual;
    return usual.min > 0.0 && std::isfinite (usual.max) && usual.max / usual.min >= 100.0;
}

QuantityText dragged (const QuantityText& grabbed, const PortSheet& sheet, double pixels)
{
    if (pixels == 0.0) return grabbed;   // with all its digits
    const auto& usual = sheet.limits.usual;
    const double from = grabbed.si(), part = pixels / pixels_over_range;
    double to = from + std::max (std::abs (from), grabbed.scale) * 2.0 * part;
    if (isLogarithmic (sheet) && from > 0.0)
        to = from * std::pow (usual.max / usual.min, part);
    else if (std::isfinite (usual.min) && std::isfinite (usual.max))
        to = from + (usual.max - usual.min) * part;
    return grabbed.moved (sheet.limits.hard.clamp (to));
}

}   // namespace tactus::host
