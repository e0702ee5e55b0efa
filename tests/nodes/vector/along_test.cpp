// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/along.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

namespace
{
tactus::Vec3 anyVector()
{
    const auto part = rc::gen::map (rc::gen::arbitrary<int>(), [] (int i) { return i / 1e5; });
    return { *part, *part, *part };
}
}   // namespace

using tactus::nodes::VectorAlong;

TEST_CASE ("along: the parts add up to the vector, and have the right directions", "[nodes][vector]")
{
    tactus::test::property ("any vector and direction", [] {
        const auto in = anyVector(), direction = anyVector();
        const auto out = VectorAlong {}.tick ({ .in = in, .direction = direction });
        const auto u = tactus::direction (direction);
        RC_ASSERT ((out.along * u + out.across - in).norm() <= 1e-12 * in.norm());
        RC_ASSERT (std::abs (out.across.dot (u)) <= 1e-12 * in.norm());
    });
}

TEST_CASE ("along: splits height from plane by default", "[nodes][vector]")
{
    const auto out = VectorAlong {}.tick ({ .in = { 1.0, 2.0, 3.0 } });
    CHECK (out.along == 3.0);
    CHECK (out.across == tactus::Vec3 { 1.0, 2.0, 0.0 });
}

TEST_CASE ("along: the length of the direction does not matter", "[nodes][vector]")
{
    const double size = GENERATE (1e-200, 1.0, 1e200);
    CHECK (VectorAlong {}.tick ({ .in = { 1.0, 2.0, 3.0 }, .direction = { 0.0, -size, 0.0 } }).along == -2.0);
}

TEST_CASE ("along: without a direction the whole vector is across", "[nodes][vector]")
{
    const auto out = VectorAlong {}.tick ({ .in = { 1.0, 2.0, 3.0 }, .direction = tactus::Vec3::Zero() });
    CHECK (out.along == 0.0);
    CHECK (out.across == tactus::Vec3 { 1.0, 2.0, 3.0 });
}
