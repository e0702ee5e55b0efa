// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/normalize.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::VectorNormalize;

TEST_CASE ("normalize: keeps the direction at any size", "[nodes][vector]")
{
    const double size = GENERATE (1e-300, 1e-160, 1.0, 1e160, 1e300);
    const tactus::Vec3 u = VectorNormalize {}.tick ({ .in = size * tactus::Vec3 { 2.0, -3.0, 6.0 } }).out;
    CHECK ((u - tactus::Vec3 { 2.0, -3.0, 6.0 } / 7.0).norm() < 1e-12);
}

TEST_CASE ("normalize: zero stays zero", "[nodes][vector]")
{
    CHECK (VectorNormalize {}.tick ({}).out == tactus::Vec3::Zero());
}
