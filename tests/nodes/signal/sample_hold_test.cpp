// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/sample_hold.hpp>

#include <catch2/catch.hpp>

#include <limits>

using tactus::nodes::SignalSampleHold;

TEST_CASE ("sample and hold: takes the signal on the tick of the hit and keeps it", "[nodes][signal]")
{
    SignalSampleHold node;
    CHECK (node.tick ({ .in = 1.0 }).out == 0.0);
    CHECK (node.tick ({ .in = 2.0, .hit = 0.3 }).out == 2.0);
    CHECK (node.tick ({ .in = 3.0 }).out == 2.0);
    CHECK (node.tick ({ .in = 4.0, .hit = -1.0 }).out == 2.0);
    CHECK (node.tick ({ .in = 5.0, .hit = 1e-9 }).out == 5.0);
}

TEST_CASE ("sample and hold: a nan hit takes nothing, and the held value stays", "[nodes][signal]")
{
    SignalSampleHold node;
    node.tick ({ .in = 2.0, .hit = 1.0 });
    CHECK (node.tick ({ .in = 3.0, .hit = std::numeric_limits<double>::quiet_NaN() }).out == 0.0);
    CHECK (node.tick ({ .in = 3.0 }).out == 2.0);
    CHECK (node.tick ({ .in = tactus::inf, .hit = 1.0 }).out == 0.0);
    CHECK (node.tick ({ .in = 3.0 }).out == 2.0);
}
