// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/map.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::SignalMap;

TEST_CASE ("map: is straight between its points and constant beyond its ends", "[nodes][signal]")
{
    SignalMap node;
    node.settings.curve = { { 0.0, 1.0, 3.0 }, { 10.0, 20.0, 0.0 } };
    CHECK (node.tick ({ .in = -5.0 }).out == 10.0);
    CHECK (node.tick ({ .in = 0.5 }).out == 15.0);
    CHECK (node.tick ({ .in = 1.0 }).out == 20.0);
    CHECK (node.tick ({ .in = 2.0 }).out == 10.0);
    CHECK (node.tick ({ .in = 7.0 }).out == 0.0);
    CHECK (node.claims().amplitude == 20.0);
}

TEST_CASE ("map: passes 0 to 1 unchanged by default", "[nodes][signal]")
{
    CHECK (SignalMap {}.tick ({ .in = 0.3 }).out == Approx (0.3));
}
