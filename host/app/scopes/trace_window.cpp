// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_window.hpp"

#include <cmath>

namespace tactus::host
{

namespace
{
std::uint64_t tickAtOrAfter (double t) { return t <= 0.0 ? 0 : static_cast<std::uint64_t> (std::ceil (t)); }

/// The columns of a window. Numbers of columns count from tick 0: that of a tick is floor (tick / ticks_each).
struct ColumnGrid
{
    double ticks_each, first, end;   // the last two are numbers

    ColumnGrid (double from, double to, std::size_t at_most)
        : ticks_each (std::max (1.0, (to - from) / static_cast<double> (std::max<std::size_t> (1, at_most)))), first (std::floor (from / ticks_each)),
          end (std::ceil (to / ticks_each))
    {
    }

    TraceColumns empty() const
    {
        return { ticks_each, first * ticks_each, std::vector<TraceColumn> (static_cast<std::size_t> (std::max (0.0, end - first))) };
    }

    double numberOf (std::uint64_t tick) const noexcept { return std::floor (static_cast<double> (tick) / ticks_each); }

    std::uint64_t firstTickOf (double number) const noexcept
    {
        auto tick = tickAtOrAfter (number * ticks_each);
        while (numberOf (tick) < number)
            ++tick;
        while (tick > 0 && numberOf (tick - 1) >= number)
            --tick;
        return tick;
    }

    /// Calls f (index, tick, next) for each column that has ticks of the trace, with its first tick and the first of the next column. The
    /// column of a tick is computed once for each column, because a division takes as long as ten comparisons.
    template <typename F>
    void each (const Trace& trace, double from, double to, F&& f) const
    {
        const auto last = std::min (tickAtOrAfter (to), trace.end());
        for (auto tick = std::max (tickAtOrAfter (from), trace.begin()); tick < last;)
        {
            const double number = std::max (first, numberOf (tick));
            if (number >= end) break;
            const auto next = std::min (last, firstTickOf (number + 1.0));
            f (static_cast<std::size_t> (number - first), tick, next);
            tick = next;
        }
    }
};
}   // namespace

TraceColumns columnsOf (const Trace& trace, double from, double to, std::size_t at_most)
{
    const ColumnGrid grid { from, to, at_most };
    auto columns = grid.empty();
    grid.each (trace, from, to, [&] (std::size_t i, std::uint64_t tick, std::uint64_t next) { columns.all[i].extent = extentOf (trace, tick, next); });
    return columns;
}

const TraceColumns& MovingColumns::update (const std::shared_ptr<const Trace>& trace, double from, double to, std::size_t at_most)
{
    const ColumnGrid grid { from, to, at_most };
    auto columns = grid.empty();
    const bool goes_on = of == trace && beginnings == trace->beginnings() && shown.ticks_each == columns.ticks_each;
    const double known_from = goes_on ? whole_from : 0.0, known_to = goes_on ? whole_to : 0.0, first_before = std::round (shown.first / shown.ticks_each);
    whole_from = whole_to = 0.0;
    grid.each (*trace, from, to, [&] (std::size_t i, std::uint64_t tick, std::uint64_t next) {
        const double number = grid.first + static_cast<double> (i);
        const bool is_whole = tick == grid.firstTickOf (number) && next == grid.firstTickOf (number + 1.0);
        if (is_whole && number >= known_from && number < known_to)
            columns.all[i] = shown.all[static_cast<std::size_t> (number - first_before)];
        else
        {
            columns.all[i].extent = extentOf (*trace, tick, next);
            read += next - tick;
        }
        if (! is_whole) return;
        if (whole_from == whole_to) whole_from = number;
        whole_to = number + 1.0;
    });
    of = trace;
    beginnings = trace->beginnings();
    shown = std::move (columns);
    return shown;
}

Extent MovingColumns::extent() const noexcept
{
    Extent all;
    for (const auto& c : shown.all)
        if (! c.extent.isEmpty()) all.include (c.extent);
    return all;
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
