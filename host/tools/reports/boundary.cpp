// SPDX-License-Identifier: MIT
#include "boundary.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tactus::host
{

namespace
{
struct Corner
{
    double x, y, value;

    bool isInside() const { return value < 0.0; }
};

/// The point where the boundary crosses the side between two corners; empty if it does not.
std::optional<Corner> crossing (const std::function<double (double, double)>& f, Corner a, Corner b, bool is_cheap)
{
    if (std::isnan (a.value) || std::isnan (b.value) || a.isInside() == b.isInside()) return std::nullopt;
    for (int i = 0; is_cheap && i < 7; ++i)
    {
        Corner middle { 0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.0 };
        middle.value = f (middle.x, middle.y);
        if (std::isnan (middle.value)) return std::nullopt;
        (middle.isInside() == a.isInside() ? a : b) = middle;
    }
    const double part = is_cheap ? 0.5 : a.value / (a.value - b.value);
    return Corner { a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), 0.0 };
}
}   // namespace

Boundary boundaryOf (const std::function<double (double, double)>& f, const GridAxis& x, const GridAxis& y)
{
    const auto columns = x.values.size(), rows = y.values.size();
    std::vector<Corner> corners;
    for (const double at_x : x.values)
        for (const double at_y : y.values)
            corners.push_back ({ at_x, at_y, f (at_x, at_y) });
    const auto corner = [&] (std::size_t c, std::size_t r) { return corners[c * rows + r]; };

    Boundary line;
    const auto gap = [&] {
        line.x.push_back (std::numeric_limits<double>::quiet_NaN());
        line.y.push_back (line.x.back());
    };
    for (std::size_t c = 0; c + 1 < columns; ++c)
        for (std::size_t r = 0; r + 1 < rows; ++r)
        {
            const std::array around { corner (c, r), corner (c + 1, r), corner (c + 1, r + 1), corner (c, r + 1) };
            std::vector<Corner> found;
            for (std::size_t side = 0; side < 4; ++side)
                if (const auto at = crossing (f, around[side], around[(side + 1) % 4], side % 2 == 0 ? x.is_cheap : y.is_cheap)) found.push_back (*at);
            for (std::size_t i = 0; i + 1 < found.size(); i += 2)
            {
                for (const auto& end : { found[i], found[i + 1] })
                {
                    line.x.push_back (end.x);
                    line.y.push_back (end.y);
                }
                gap();
            }
        }
    return line;
}

}   // namespace tactus::host
