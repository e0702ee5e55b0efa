// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/constant.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("constant: gives its value on every tick", "[nodes][signal]")
{
    tactus::nodes::SignalConstant node;
    CHECK (node.tick ({}).out == 0.0);
    node.params.value = 2.5;
    CHECK (node.tick ({}).out == 2.5);
    CHECK (node.tick ({}).out == 2.5);
}
