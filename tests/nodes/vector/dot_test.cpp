// SPDX-License-Identifier: MIT
#include <nodes/vector/dot.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("dot: of a vector with itself is its length squared, across it nothing", "[nodes][vector]")
{
    tactus::nodes::VectorDot node;
    CHECK (node.tick ({ .a = { 2.0, -3.0, 6.0 }, .b = { 2.0, -3.0, 6.0 } }).amount == 49.0);
    CHECK (node.tick ({ .a = { 2.0, -3.0, 6.0 }, .b = { 3.0, 2.0, 0.0 } }).amount == 0.0);
}
