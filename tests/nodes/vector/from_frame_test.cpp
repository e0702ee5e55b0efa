// SPDX-License-Identifier: MIT
#include <tactus/nodes/vector/from_frame.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <numbers>

namespace
{
tactus::Vec3 anyVector()
{
    const auto part = rc::gen::map (rc::gen::arbitrary<int>(), [] (int i) { return i / 1e5; });
    return { *part, *part, *part };
}
}   // namespace

using tactus::Vec3;
using tactus::nodes::VectorFromFrame;

namespace
{
VectorFromFrame frameOf (const Vec3& origin, const Vec3& rotation)
{
    VectorFromFrame node;
    node.params = { origin, rotation };
    node.update();
    return node;
}
}   // namespace

TEST_CASE ("from frame: a quarter turn about z takes right to away", "[nodes][vector]")
{
    const auto node = frameOf ({ 1.0, 0.0, 0.0 }, { 0.0, 0.0, std::numbers::pi / 2 });
    CHECK ((node.tick ({ .in = Vec3::UnitX() }).out - Vec3 { 1.0, 1.0, 0.0 }).norm() < 1e-15);
}

TEST_CASE ("from frame: rotation keeps lengths, angles and handedness", "[nodes][vector]")
{
    tactus::test::property ("any rotation", [] {
        const Vec3 rotation = anyVector() * 1e-4;
        const auto node = frameOf (Vec3::Zero(), rotation);
        tactus::Mat3 turn;
        for (int i = 0; i < 3; ++i)
            turn.col (i) = node.tick ({ .in = Vec3::Unit (i) }).out;
        RC_ASSERT ((turn.transpose() * turn - tactus::Mat3::Identity()).norm() < 1e-14);
        RC_ASSERT (std::abs (turn.determinant() - 1.0) < 1e-14);
        RC_ASSERT ((turn * rotation - rotation).norm() <= 1e-14 * (1.0 + rotation.norm()));
    });
}

TEST_CASE ("from frame: small rotations add up like vectors", "[nodes][vector]")
{
    const Vec3 r { 1e-9, -2e-9, 3e-9 }, in { 0.1, 0.2, 0.3 };
    CHECK ((frameOf (Vec3::Zero(), r).tick ({ .in = in }).out - (in + r.cross (in))).norm() < 1e-16);
}
