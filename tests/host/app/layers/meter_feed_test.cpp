// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/layers/meter_feed.hpp>

#include "host/app/scopes/made_trace.hpp"

#include <catch2/catch.hpp>

using namespace tactus::host;

TEST_CASE ("a new run begins with a new peak", "[layers]")
{
    const auto add = [] (Trace& trace, std::uint64_t ticks, double value) {
        for (std::uint64_t k = 0; k < ticks; ++k)
            trace.add (k, value);
    };
    const auto trace = emptyTrace ("mix.out"), other = emptyTrace ("mix.out");
    MeterFeed feed;
    feed.take ({ trace }, 1.0, 0.01);
    add (*trace, 50, 2.0);
    feed.take ({ trace }, 1.0, 0.01);
    CHECK (feed.meter.peak() == 2.0);

    add (*trace, 10, 0.5);   // from tick 0 on
    feed.take ({ trace }, 1.0, 0.01);
    CHECK (feed.meter.peak() == 0.5);
    CHECK (feed.newest == 0.5);

    add (*other, 60, 0.25);
    feed.take ({ other }, 1.0, 0.01);
    CHECK (feed.meter.peak() == 0.25);
}

TEST_CASE ("a run whose level comes from another trace keeps its peak, as after the panel was hidden", "[layers]")
{
    const auto before = emptyTrace ("mix.in[0]"), after = emptyTrace ("mix.level[0]");
    MeterFeed feed;
    feed.take ({ before }, 1.0, 0.01);
    for (std::uint64_t k = 0; k < 50; ++k)
        before->add (k, 2.0);
    feed.take ({ before }, 1.0, 0.01);
    REQUIRE (feed.meter.peak() == 2.0);
    feed.take ({ after }, 1.0, 0.01);   // nothing has come yet
    CHECK_FALSE (feed.has_changed);
    for (std::uint64_t k = 60; k < 70; ++k)
        after->add (k, 0.5);
    feed.take ({ after }, 1.0, 0.01);
    CHECK_FALSE (feed.has_changed);
    CHECK (feed.newest == 0.5);
    CHECK (feed.meter.peak() == 2.0);
}

TEST_CASE ("a meter shows the largest peak of the last two seconds", "[layers]")
{
    Meter meter;
    const auto play = [&meter] (double level, double seconds) {
        const std::vector<double> samples { level };
        for (int k = 0; k < static_cast<int> (seconds / 0.05 + 0.5); ++k)
            meter.take (samples, 1, 0.05);
    };
    play (2.0, 0.1);
    play (0.0, 1.4);
    play (1.0, 0.1);
    play (0.0, 0.3);
    CHECK (meter.peak() == 2.0);
    play (0.0, 0.4);
    CHECK (meter.peak() == 1.0);   // 0.8 s old
    play (0.0, 1.4);
    CHECK (meter.peak() == 0.0);
}
