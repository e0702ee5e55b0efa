// SPDX-License-Identifier: MIT
#include "feed.hpp"

#include <algorithm>
#include <cmath>

namespace tactus
{

namespace
{
/// Times in files are decimal, so 1/dt differs slightly from the intended rate.
double snapped (double rate)
{
    const double whole = std::round (rate);
    return std::abs (rate - whole) < 1e-6 * rate ? whole : rate;
}
}   // namespace

Result<Feed> Feed::make (Table t, const std::string& name, double rate_hz, double graph_rate_hz)
{
    Feed f;
    f.table = std::move (t);
    f.time = f.table.column ("t");
    for (std::size_t c = 0; c < f.table.columns.size(); ++c)
        if (c != f.time)
        {
            f.names.push_back (f.table.columns[c]);
            f.columns.push_back (c);
        }
    const auto rows = f.table.rows();
    if (rows == 0) return Message::error ("feed/empty", name, "there is no row below the header", "give one row per tick");

    f.count = rows;
    f.rate_hz = rate_hz > 0.0 ? rate_hz : graph_rate_hz;
    if (! f.time) return f;

    std::vector<double> steps;
    for (std::size_t r = 0; r < rows; ++r)
    {
        const double now = f.table.at (r, *f.time);
        const auto place = name + ":" + std::to_string (r + 2);
        if (! std::isfinite (now)) return Message::error ("feed/bad_time", place, "the time of this row is not a number", "give every row its time in seconds");
        if (r == 0) continue;
        steps.push_back (now - f.table.at (r - 1, *f.time));
        if (! (steps.back() > 0.0))
            return Message::error ("feed/time_order", place, "t is not larger than in the row before",
                                   "sort the rows by time, and keep only one row for each time");
    }
    if (rate_hz > 0.0)
    {
        f.held = true;
        const double last = f.table.at (rows - 1, *f.time) - f.table.at (0, *f.time);
        constexpr double most = 1e10;
        if (! (last * rate_hz < most))
            return Message::error ("run/too_long", name, "the times in this file span more than 10^10 ticks at the rate of the run",
                                   "check that t is in seconds; if it is, give a lower --rate or fewer rows");
        f.count = static_cast<std::size_t> (std::floor (last * rate_hz + 1e-6)) + 1;
    }
    else if (! steps.empty())
    {
        std::ranges::nth_element (steps, steps.begin() + static_cast<std::ptrdiff_t> (steps.size() / 2));
        f.rate_hz = snapped (1.0 / steps[steps.size() / 2]);
    }
    return f;
}

void Feed::operator() (std::size_t k, std::span<double> values) noexcept
{
    if (held)
    {
        const double now = table.at (0, *time) + (static_cast<double> (k) + 1e-6) / rate_hz;
        while (row + 1 < table.rows() && table.at (row + 1, *time) <= now)
            ++row;
    }
    else
        row = std::min (k, table.rows() - 1);
    for (std::size_t c = 0; c < columns.size(); ++c)
        values[c] = table.at (row, columns[c]);
}

}   // namespace tactus
