// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/split.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("split: gives the three components", "[nodes][vector]")
{
    const auto out = tactus::nodes::VectorSplit {}.tick ({ .in = { 1.0, 2.0, 3.0 } });
    CHECK (out.x == 1.0);
    CHECK (out.y == 2.0);
    CHECK (out.z == 3.0);
}

TEST_CASE ("split: a vector with one bad component is bad as a whole", "[nodes][vector]")
{
    CHECK (tactus::nodes::VectorSplit {}.tick ({ .in = { 1.0, tactus::inf, 3.0 } }).x == 0.0);
}
