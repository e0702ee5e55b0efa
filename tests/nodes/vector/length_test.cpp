// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/length.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("length: is correct from the smallest vectors to the largest", "[nodes][vector]")
{
    const double size = GENERATE (1e-300, 1e-160, 1.0, 1e160, 1e300);
    const tactus::Vec3 v = size * tactus::Vec3 { 2.0, -3.0, 6.0 };
    CHECK (tactus::nodes::VectorLength {}.tick ({ .in = v }).amount / size == Approx (7.0));
}
