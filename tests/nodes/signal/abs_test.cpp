// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/abs.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("abs: drops the sign", "[nodes][signal]")
{
    tactus::nodes::SignalAbs node;
    CHECK (node.tick ({ .in = -3.0 }).out == 3.0);
    CHECK (node.tick ({ .in = 3.0 }).out == 3.0);
    CHECK_FALSE (std::signbit (node.tick ({ .in = -0.0 }).out));
}
