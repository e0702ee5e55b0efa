// SPDX-License-Identifier: MIT
#include "polyline.hpp"

#include <host/tools/figures/axis.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_set>

namespace tactus::host
{

namespace
{
/// A position rounded to half a pixel, as one number.
std::uint32_t cellOf (PixelPoint point) noexcept
{
    const auto half_pixels = [] (float at) { return static_cast<std::uint32_t> (std::clamp (std::lround (2.0f * at), 0L, 0xffffL)); };
    return half_pixels (point.x) << 16 | half_pixels (point.y);
}

/// A run of points within one column of pixels; at most four of them are kept.
class Column
{
public:
    void add (PixelPoint point)
    {
        if (count == 0)
            first = low = high = last = { point, 0 };
        last = { point, count };
        if (point.y < low.point.y)
            low = last;
        if (point.y > high.point.y)
            high = last;
        ++count;
    }

    void moveTo (Polyline& line)
    {
        if (count == 0)
            return;

        std::array kept { first, low, high, last };
        std::ranges::sort (kept, {}, &NumberedPoint::number);
        for (std::size_t i = 0; i < kept.size(); ++i)
            if (i == 0 || kept[i].number != kept[i - 1].number)
                line.push_back (kept[i].point);
        count = 0;
    }

    bool holds (float x) const { return count > 0 && std::floor (x) == std::floor (first.point.x); }

private:
    struct NumberedPoint
    {
        PixelPoint point;
        std::size_t number = 0;
    };
    NumberedPoint first, low, high, last;
    std::size_t count = 0;
};

/// Cuts a line where it retraces segments in `drawn`, and adds its own segments to `drawn`.
void keepWhatIsNew (const Polyline& line, std::unordered_set<std::uint64_t>& drawn, std::vector<Polyline>& lines)
{
    Polyline fresh;
    const auto finish = [&] {
        if (fresh.size() > 1)
            lines.push_back (fresh);
        fresh.clear();
    };

    for (std::size_t i = 1; i < line.size(); ++i)
    {
        const auto [a, b] = std::minmax ({ cellOf (line[i - 1]), cellOf (line[i]) });
        if (drawn.insert (std::uint64_t { a } << 32 | b).second)
        {
            if (fresh.empty())
                fresh.push_back (line[i - 1]);
            fresh.push_back (line[i]);
        }
        else
            finish();
    }
    finish();
}

std::vector<Polyline> withoutRetracing (const std::vector<Polyline>& lines)
{
    constexpr std::size_t worth_it = 20'000;   // number of points; with fewer, drawing is faster than comparing

    std::size_t points = 0;
    for (const auto& line : lines)
        points += line.size();
    if (points < worth_it)
        return lines;

    std::unordered_set<std::uint64_t> drawn;
    std::vector<Polyline> fresh;
    for (const auto& line : lines)
    {
        if (line.size() == 1)
            fresh.push_back (line);
        keepWhatIsNew (line, drawn, fresh);
    }
    return fresh;
}
}   // namespace

std::vector<Polyline> linesThrough (std::span<const double> x, std::span<const double> y, const PixelMap& to_x, const PixelMap& to_y)
{
    std::vector<Polyline> lines;
    Polyline line;
    Column column;

    const auto finish = [&] {
        column.moveTo (line);
        if (! line.empty())
            lines.push_back (line);
        line.clear();
    };

    for (std::size_t i = 0; i < std::min (x.size(), y.size()); ++i)
    {
        if (! isPlottable (x[i]) || ! isPlottable (y[i]))
        {
            finish();
            continue;
        }

        const PixelPoint point { to_x (x[i]), to_y (y[i]) };
        if (! column.holds (point.x))
            column.moveTo (line);
        column.add (point);
    }
    finish();
    return withoutRetracing (lines);
}

std::vector<PixelPoint> dotsAt (std::span<const double> x, std::span<const double> y, const PixelMap& to_x, const PixelMap& to_y)
{
    std::vector<PixelPoint> dots;
    std::unordered_set<std::uint32_t> taken;

    for (std::size_t i = 0; i < std::min (x.size(), y.size()); ++i)
        if (isPlottable (x[i]) && isPlottable (y[i]))
            if (const PixelPoint point { to_x (x[i]), to_y (y[i]) }; taken.insert (cellOf (point)).second)
                dots.push_back (point);
    return dots;
}

}   // namespace tactus::host
