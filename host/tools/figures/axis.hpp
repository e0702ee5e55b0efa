// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// True for values that a plot can show. The others leave gaps: nan, inf, and values that would overflow when a range is widened.
bool isPlottable (double value) noexcept;

/// The range from the lowest to the highest of some values.
struct Extent
{
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    bool isEmpty() const noexcept { return low > high; }
    double size() const noexcept { return high - low; }
    void include (double value) noexcept;
    void include (const Extent& other) noexcept;
    bool operator== (const Extent&) const = default;
};

/// The extent with a margin on both sides. Its size is never zero: a constant gets a margin of a tenth of its value, and zero
/// becomes -1…1. Values that differ only in the tenth digit count as constant, so that noise is not magnified.
Extent widened (const Extent& extent, double fraction) noexcept;

/// The extent, enlarged to the next ticks if they are near its ends: 0 to 1.999 s ends at 2 s.
Extent roundedOutwards (const Extent& extent, int ticks) noexcept;

/// The scale of an axis, by which it shows values: shown = (value - origin) / unit.
struct AxisScale
{
    double origin = 0.0;   // nonzero if the values differ little relative to their size
    double unit = 1.0;
    std::string label;   // "position (mm)", "gain (×10⁻⁶)", "position − 1.2 m (µm)"

    double shown (double value) const noexcept { return (value - origin) / unit; }
    Extent shown (const Extent& extent) const noexcept { return { shown (extent.low), shown (extent.high) }; }
};

/// Picks the SI prefix that gives short numbers, or a power of ten for units without prefixes.
AxisScale axisScale (const Extent& values, std::string_view name, std::string_view unit);

struct Tick
{
    double at = 0.0;
    std::string text;   // the same number of decimals along an axis, and a true minus sign
};

/// At most this many ticks within the extent, at multiples of 1, 2 or 5 times a power of ten. `least_step` must be such a number, or 0.
std::vector<Tick> ticksWithin (const Extent& extent, int at_most, double least_step = 0.0);

}   // namespace tactus::host
