// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/dot.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("dot: a vector with itself gives its length squared, with a vector across it 0", "[nodes][vector]")
{
    tactus::nodes::VectorDot node;
    CHECK (node.tick ({ .a = { 2.0, -3.0, 6.0 }, .b = { 2.0, -3.0, 6.0 } }).amount == 49.0);
    CHECK (node.tick ({ .a = { 2.0, -3.0, 6.0 }, .b = { 3.0, 2.0, 0.0 } }).amount == 0.0);
}
