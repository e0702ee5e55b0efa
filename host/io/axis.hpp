// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// What a plot can show. nan and inf are gaps; so is what would overflow while a range is widened.
bool isPlottable (double value) noexcept;

/// From the lowest to the highest of some values.
struct Extent
{
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    bool isEmpty() const noexcept { return low > high; }
    double size() const noexcept { return high - low; }
    void include (double value) noexcept;
    void include (const Extent& other) noexcept;
};

/// The extent with some air on both sides. Never of size zero: a constant gets a tenth of itself, zero gets -1…1.
/// What differs in the tenth digit only is constant, too; its noise is not magnified.
Extent widened (const Extent& extent, double fraction) noexcept;

/// The extent up to the ticks just beyond its ends, where those are near: 0 to 1.999 s ends at 2 s.
Extent roundedOutwards (const Extent& extent, int ticks) noexcept;

/// How values are shown along an axis: shown = (value - origin) / unit.
struct AxisScale
{
    double origin = 0.0;   // not 0 where values differ little beside their size
    double unit = 1.0;
    std::string label;   // "position (mm)", "gain (×10⁻⁶)", "position − 1.2 m (µm)"

    double shown (double value) const noexcept { return (value - origin) / unit; }
    Extent shown (const Extent& extent) const noexcept { return { shown (extent.low), shown (extent.high) }; }
};

/// Picks the SI prefix, or the power of ten where the unit takes none, with which numbers are short.
AxisScale axisScale (const Extent& values, std::string_view name, std::string_view unit);

struct Tick
{
    double at = 0.0;
    std::string text;   // equally many decimals along an axis, and a true minus sign
};

/// At most so many ticks at multiples of 1, 2 or 5 times a power of ten within the extent.
std::vector<Tick> ticksWithin (const Extent& extent, int at_most);

}   // namespace tactus::host
