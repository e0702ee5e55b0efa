// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/cross.hpp>

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

TEST_CASE ("cross: is right-handed", "[nodes][vector]")
{
    CHECK (tactus::nodes::VectorCross {}.tick ({ .a = tactus::Vec3::UnitX(), .b = tactus::Vec3::UnitY() }).out == tactus::Vec3::UnitZ());
}

TEST_CASE ("cross: is at right angles to both, and changes sign with their order", "[nodes][vector]")
{
    tactus::test::property ("any two vectors", [] {
        const auto a = anyVector(), b = anyVector();
        tactus::nodes::VectorCross node;
        const auto c = node.tick ({ .a = a, .b = b }).out;
        const double tolerance = 1e-12 * (a.squaredNorm() * b.norm() + b.squaredNorm() * a.norm());
        RC_ASSERT (std::abs (c.dot (a)) <= tolerance);
        RC_ASSERT (std::abs (c.dot (b)) <= tolerance);
        RC_ASSERT (node.tick ({ .a = b, .b = a }).out == -c);
    });
}
