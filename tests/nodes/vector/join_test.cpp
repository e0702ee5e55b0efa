// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/join.hpp>
#include <tactus/nodes/vector/split.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("join: undoes split", "[nodes][vector]")
{
    const auto parts = tactus::nodes::VectorSplit {}.tick ({ .in = { 1.0, 2.0, 3.0 } });
    const auto out = tactus::nodes::VectorJoin {}.tick ({ .x = parts.x, .y = parts.y, .z = parts.z });
    CHECK (out.out == tactus::Vec3 { 1.0, 2.0, 3.0 });
}
