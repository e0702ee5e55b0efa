// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/scale.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("scale: multiplies every component, by 1 by default", "[nodes][vector]")
{
    tactus::nodes::VectorScale node;
    CHECK (node.tick ({ .in = { 1.0, 2.0, 3.0 } }).out == tactus::Vec3 { 1.0, 2.0, 3.0 });
    CHECK (node.tick ({ .in = { 1.0, 2.0, 3.0 }, .gain = -2.0 }).out == tactus::Vec3 { -2.0, -4.0, -6.0 });
}
