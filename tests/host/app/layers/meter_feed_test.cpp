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
