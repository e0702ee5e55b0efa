// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/clamp.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::SignalClamp;

TEST_CASE ("clamp: passes values within the bounds and clamps the rest", "[nodes][signal]")
{
    SignalClamp node { .params = { .min = -0.5, .max = 2.0 } };
    CHECK (node.tick ({ .in = 1.0 }).out == 1.0);
    CHECK (node.tick ({ .in = 1e300 }).out == 2.0);
    CHECK (node.tick ({ .in = -1e300 }).out == -0.5);
    CHECK (node.claims().amplitude == 2.0);
}

TEST_CASE ("clamp: an infinite signal is a fault, not the upper bound", "[nodes][signal]")
{
    CHECK (SignalClamp {}.tick ({ .in = tactus::inf }).out == 0.0);
}

TEST_CASE ("clamp: if the lower bound is above the upper one, the upper one takes precedence", "[nodes][signal]")
{
    SignalClamp node { .params = { .min = 1.0, .max = -1.0 } };
    CHECK (node.tick ({ .in = 0.0 }).out == -1.0);
}
