// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/gain.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("gain: passes a signal unchanged by default, and inverts it with a negative factor", "[nodes][signal]")
{
    tactus::nodes::SignalGain node;
    CHECK (node.tick ({ .in = 0.3 }).out == 0.3);
    node.params.gain = -2.0;
    CHECK (node.tick ({ .in = 0.3 }).out == -0.6);
}

TEST_CASE ("gain: a result that does not fit into a double gives 0", "[nodes][signal]")
{
    tactus::nodes::SignalGain node { .params = { .gain = 1e300 } };
    CHECK (node.tick ({ .in = 1e300 }).out == 0.0);
}
