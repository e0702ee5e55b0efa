// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_trace.hpp"

#include <support/property.hpp>

#include <cmath>

using namespace tactus::host;

namespace
{
std::vector<double> thousandths (const std::vector<short>& from)
{
    std::vector<double> all;
    for (const short s : from)
        all.push_back (s % 97 == 0 ? std::nan ("") : s / 1000.0);   // some are missing
    return all;
}
}   // namespace

TEST_CASE ("scopes: a column of pixels keeps the lowest and highest of its ticks, and gaps stay gaps", "[app][scopes]")
{
    tactus::test::property ("any signal, window and width", [] (const std::vector<short>& signal) {
        const auto values = thousandths (signal);
        const auto first = *rc::gen::inRange<std::uint64_t> (0, 50000);
        const auto trace = traceOf (values, first);
        const auto from = static_cast<double> (first) + *rc::gen::inRange (-300, 300) / 3.0;
        const auto to = from + *rc::gen::inRange (1, 900) / 2.0;
        const auto width = *rc::gen::inRange<std::size_t> (1, 200);
        const auto columns = columnsOf (*trace, from, to, width);

        RC_ASSERT (columns.all.size() <= width + 2 || columns.ticks_each == 1.0);
        std::vector<Extent> expected (columns.all.size());
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            const auto tick = static_cast<double> (first + i);
            if (tick < from || tick >= to || std::isnan (values[i])) continue;
            const auto column = static_cast<std::size_t> (std::floor (tick / columns.ticks_each) - std::floor (from / columns.ticks_each));
            RC_ASSERT (column < expected.size());
            expected[column].include (values[i]);
        }
        for (std::size_t i = 0; i < expected.size(); ++i)
        {
            RC_ASSERT (columns.all[i].extent.low == expected[i].low);
            RC_ASSERT (columns.all[i].extent.high == expected[i].high);
        }
    });
}

TEST_CASE ("scopes: columns keep the same ticks while the window moves, so that peaks do not shimmer", "[app][scopes]")
{
    std::vector<double> values (5000, 0.0);
    values[2345] = 1.0;
    const auto trace = traceOf (values);
    std::vector<double> seen_at;
    for (double from = 1000.0; from < 1100.0; from += 7.0)
    {
        const auto columns = columnsOf (*trace, from, from + 2000.0, 100);
        for (std::size_t i = 0; i < columns.all.size(); ++i)
            if (columns.all[i].extent.high == 1.0) seen_at.push_back (columns.first + static_cast<double> (i) * columns.ticks_each);
    }
    REQUIRE (seen_at.size() == 15);
    for (const double at : seen_at)
        CHECK (at == seen_at.front());
}

TEST_CASE ("scopes: the trigger is the latest crossing on the selected edge", "[app][scopes]")
{
    tactus::test::property ("any signal and level", [] (const std::vector<short>& signal, bool rises, short level) {
        const auto values = thousandths (signal);
        const auto trace = traceOf (values, 100);
        const ScopeTrigger trigger { rises ? ScopeTrigger::Edge::rising : ScopeTrigger::Edge::falling, level / 3000.0 };
        const auto before = *rc::gen::inRange<std::uint64_t> (90, 250);
        const auto passed = [&] (std::size_t i) {
            if (rises) return values[i - 1] < trigger.level && values[i] >= trigger.level;
            return values[i - 1] > trigger.level && values[i] <= trigger.level;
        };
        std::optional<std::uint64_t> expected;
        for (std::size_t i = 1; i < values.size() && 100 + i < before; ++i)
            if (passed (i)) expected = 100 + i;
        RC_ASSERT (latestCrossing (*trace, trigger, 0.0, before) == expected);
    });
}

TEST_CASE ("scopes: noise around the level triggers only once, and a gap is not a crossing", "[app][scopes]")
{
    const auto noisy = traceOf ({ -1.0, -0.01, 0.01, -0.01, 0.01, -0.01, 0.01 });
    CHECK (latestCrossing (*noisy, { ScopeTrigger::Edge::rising, 0.0 }, 0.1, 100) == 2u);
    CHECK (latestCrossing (*noisy, { ScopeTrigger::Edge::rising, 0.0 }, 0.0, 100) == 6u);
    CHECK_FALSE (latestCrossing (*traceOf ({ -1.0, std::nan (""), 1.0 }), { ScopeTrigger::Edge::rising, 0.0 }, 0.0, 100));
    CHECK_FALSE (latestCrossing (*noisy, { ScopeTrigger::Edge::off, 0.0 }, 0.0, 100));
}

TEST_CASE ("scopes: the window ends at the newest tick, or surrounds the latest trigger for which it is complete", "[app][scopes]")
{
    std::vector<double> values (2000);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::sin (2.0 * 3.14159265358979 * static_cast<double> (i) / 400.0);   // rises through 0 at 400, 800, …
    const TraceList traces { traceOf (values) };
    const auto free = windowOf (traces, 0.5, {}, 0.0);
    CHECK (free.to == 2000.0);
    CHECK (free.from == 1500.0);

    const auto held = windowOf (traces, 0.5, { ScopeTrigger::Edge::rising, 0.0 }, 0.0);
    REQUIRE (held.trigger);
    CHECK (std::abs (static_cast<double> (*held.trigger) - 1200.0) <= 1.0);   // 1600 is not followed by 400 ticks yet
    CHECK (held.to <= 2000.0);
    CHECK (held.to - held.from == 500.0);

    CHECK_FALSE (windowOf (traces, 0.5, { ScopeTrigger::Edge::rising, 5.0 }, 0.0).trigger);
}

TEST_CASE ("scopes: a trace visits its ticks in order, even across the end of its ring buffer", "[app][scopes]")
{
    auto trace = emptyTrace ("a", 10.0);   // holds 100 values
    for (std::uint64_t i = 0; i < 250; ++i)
        trace->add (i, static_cast<double> (i));
    std::uint64_t expected = 150, count = 0;
    trace->each (0, 1000, [&] (std::uint64_t tick, double v) {
        CHECK (tick == expected++);
        CHECK (v == static_cast<double> (tick));
        ++count;
    });
    CHECK (count == 100);
}

TEST_CASE ("a window that moves along a growing trace has the columns of the whole window, and reads only new ticks", "[app][scopes]")
{
    tactus::test::property ("moving columns", [] {
        const double rate = *rc::gen::element (200.0, 1000.0, 4000.0), seconds = *rc::gen::element (0.05, 1.0, 7.3, 10.0);
        const auto trace = emptyTrace ("a.force", rate);
        const auto width = *rc::gen::inRange<std::size_t> (1, 700);
        MovingColumns moving;
        std::uint64_t tick = *rc::gen::inRange<std::uint64_t> (0, 50'000), updates = 0;
        std::uint64_t added = 0;
        for (const int steps : *rc::gen::container<std::vector<int>> (40, rc::gen::inRange (0, 900)))
        {
            for (int i = 0; i < steps; ++i, ++tick, ++added)
                trace->add (tick, std::sin (0.013 * static_cast<double> (tick * tick % 1009)));
            if (steps % 17 == 3) tick += 5;              // the window was busy
            if (steps % 97 == 5) tick = tick / 2 + 13;   // another run begins
            const double to = static_cast<double> (trace->end()), from = to - seconds * rate;
            const auto& now = moving.update (trace, from, to, width);
            const auto whole = columnsOf (*trace, from, to, width);
            ++updates;
            RC_ASSERT (now.first == whole.first);
            RC_ASSERT (now.ticks_each == whole.ticks_each);
            RC_ASSERT (now.all.size() == whole.all.size());
            for (std::size_t i = 0; i < whole.all.size(); ++i)
                RC_ASSERT (now.all[i].extent == whole.all[i].extent);
        }
        const auto each = static_cast<std::uint64_t> (moving.columns().ticks_each) + 1;
        RC_ASSERT (moving.ticksRead() <= added + 3 * each * updates);
    });
}
