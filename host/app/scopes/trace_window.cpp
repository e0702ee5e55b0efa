// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_window.hpp"

#include <cmath>

namespace tactus::host
{

namespace
{
std::uint64_t tickAtOrAfter (double t) { return t <= 0.0 ? 0 : static_cast<std::uint64_t> (std::ceil (t)); }
}   // namespace

TraceColumns columnsOf (const Trace& trace, double from, double to, std::size_t at_most)
{
    TraceColumns columns;
    columns.ticks_each = std::max (1.0, (to - from) / static_cast<double> (std::max<std::size_t> (1, at_most)));
    const double first = std::floor (from / columns.ticks_each);
    columns.first = first * columns.ticks_each;
    columns.all.resize (static_cast<std::size_t> (std::max (0.0, std::ceil (to / columns.ticks_each) - first)));
    // The column of a tick is floor (tick / ticks_each). It is computed once for each column, because a division takes as long as ten comparisons.
    const auto columnOf = [&] (std::uint64_t tick) { return std::floor (static_cast<double> (tick) / columns.ticks_each) - first; };
    const auto firstTickOf = [&] (double column) {
        auto tick = tickAtOrAfter ((first + column) * columns.ticks_each);
        while (columnOf (tick) < column)
            ++tick;
        while (tick > 0 && columnOf (tick - 1) >= column)
            --tick;
        return tick;
    };
    const auto begin = std::max (tickAtOrAfter (from), trace.begin()), end = std::min (tickAtOrAfter (to), trace.end());
    for (auto tick = begin; tick < end;)
    {
        const double column = std::max (0.0, columnOf (tick));
        if (column >= static_cast<double> (columns.all.size())) break;
        const auto next = std::min (end, firstTickOf (column + 1.0));
        columns.all[static_cast<std::size_t> (column)].extent = extentOf (trace, tick, next);
        tick = next;
    }
    return columns;
}

Extent extentOf (const Trace& trace, double from, double to) { return extentOf (trace, tickAtOrAfter (from), tickAtOrAfter (to)); }

Extent extentOf (const Trace& trace, std::uint64_t from, std::uint64_t to)
{
    Extent extent;
    trace.each (from, to, [&] (std::uint64_t, double v) {
        if (isPlottable (v)) extent.include (v);
    });
    return extent;
}

std::optional<std::uint64_t> latestCrossing (const Trace& trace, const ScopeTrigger& trigger, double hysteresis, std::uint64_t before)
{
    if (trigger.edge == ScopeTrigger::Edge::off) return std::nullopt;
    const double sign = trigger.edge == ScopeTrigger::Edge::rising ? 1.0 : -1.0;
    std::optional<std::uint64_t> found;
    bool armed = false;
    trace.each (trace.begin(), before, [&] (std::uint64_t tick, double v) {
        const double beyond = sign * (v - trigger.level);
        if (! (beyond < 0.0 || beyond >= 0.0))
            armed = false;
        else if (beyond < 0.0)
            armed = armed || beyond <= -hysteresis;
        else if (armed)
        {
            found = tick;
            armed = false;
        }
    });
    return found;
}

std::uint64_t endOf (const TraceList& traces)
{
    std::uint64_t end = 0;
    for (const auto& t : traces)
        end = std::max (end, t->end());
    return end;
}

TickWindow windowOf (const TraceList& traces, double seconds, const ScopeTrigger& trigger, double hysteresis)
{
    if (traces.empty()) return {};
    const double end = static_cast<double> (endOf (traces)), ticks = seconds * traces.front()->rate();
    const double after = (1.0 - TickWindow::before_trigger) * ticks;
    if (end > after)
        if (const auto at = latestCrossing (*traces.front(), trigger, hysteresis, tickAtOrAfter (end - after)))
        {
            const double from = static_cast<double> (*at) - TickWindow::before_trigger * ticks;
            return { from, from + ticks, at };
        }
    return { end - ticks, end, std::nullopt };
}

LatestSamples latestSamples (const Trace& trace, double seconds)
{
    LatestSamples latest;
    const auto wanted = static_cast<std::uint64_t> (seconds * trace.rate());
    const auto from = trace.end() - std::min (wanted, trace.end() - trace.begin());
    latest.values.reserve (static_cast<std::size_t> (trace.end() - from));
    trace.each (from, trace.end(), [&] (std::uint64_t, double v) {
        const bool is_missing = ! isPlottable (v);
        latest.missing += is_missing;
        const double before = latest.values.empty() ? 0.0 : latest.values.back();
        latest.values.push_back (is_missing ? before : v);
    });
    return latest;
}

}   // namespace tactus::host
