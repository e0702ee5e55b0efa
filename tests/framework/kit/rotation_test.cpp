// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/geometry/rotation.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

namespace
{
Vec3 anyDirection()
{
    const auto component = rc::gen::inRange (-1'000'000, 1'000'001);
    const Vec3 v = Vec3 (*component, *component, *component) * 1e-6;
    return v.norm() < 1e-3 ? Vec3::UnitY() : Vec3 { v.normalized() };
}

/// How far the rotated `from` misses `to`, and how far the matrix is from being a rotation.
double errorOf (const Eigen::Quaterniond& q, const Vec3& from, const Vec3& to)
{
    const Mat3 turn = q.toRotationMatrix();
    return std::max ((turn * from - to).norm(), (turn * turn.transpose() - Mat3::Identity()).norm());
}
}   // namespace

TEST_CASE ("shortestRotation: rotates one direction to another", "[framework][rotation]")
{
    test::property ("any two directions, to rounding", [] {
        const Vec3 from = anyDirection(), to = anyDirection();
        const double cosine = from.dot (to);
        RC_ASSERT (errorOf (shortestRotation (from, to), from, to) <= 1e-15 + 1e-14 / (1.0 + std::max (cosine, -0.99)));
    });

    test::property ("two directions that are opposite to within 1e-6", [] {
        const Vec3 from = anyDirection();
        const Vec3 to = (-from + std::pow (10.0, -*rc::gen::inRange (7, 18)) * anyDirection()).normalized();
        RC_ASSERT (errorOf (shortestRotation (from, to), from, to) <= 1e-14);
    });

    test::property ("two vectors of any lengths", [] {
        const Vec3 from = anyDirection(), to = anyDirection();
        const double scale = std::pow (10.0, *rc::gen::inRange (-100, 101));
        RC_ASSERT (shortestRotation (scale * from, to / scale).isApprox (shortestRotation (from, to), 1e-9));
    });
}

TEST_CASE ("shortestRotation: bit-identical to Eigen's, unless the directions are opposite", "[framework][rotation]")
{
    test::property ("any two directions, including nearly opposite ones", [] {
        const Vec3 from = 3.0 * anyDirection();
        Vec3 to = anyDirection();
        if (*rc::gen::arbitrary<bool>()) to = -from + std::pow (10.0, -*rc::gen::inRange (1, 6)) * to;
        if (from.normalized().dot (to.normalized()) < -1.0 + 1e-12) return;
        RC_ASSERT (shortestRotation (from, to).coeffs() == Eigen::Quaterniond::FromTwoVectors (from, to).coeffs());
    });
}

TEST_CASE ("shortestRotation: opposite directions take a half turn about z, or about x if they are near z", "[framework][rotation]")
{
    CHECK (shortestRotation (Vec3::UnitX(), -Vec3::UnitX()).vec() == Vec3::UnitZ());
    CHECK (shortestRotation (Vec3::UnitY(), -Vec3::UnitY()).vec() == Vec3::UnitZ());
    CHECK (shortestRotation (-Vec3::UnitZ(), Vec3::UnitZ()).vec() == Vec3::UnitX());
    test::property ("the axis is at right angles to any direction", [] {
        const Vec3 v = anyDirection(), axis = perpendicularTo (v);
        RC_ASSERT (std::abs (axis.norm() - 1.0) < 1e-15);
        RC_ASSERT (std::abs (axis.dot (v)) < 1e-15);
    });
}

TEST_CASE ("rotationMatrix: a rotation vector gives a right-handed rotation about its direction", "[framework][rotation]")
{
    CHECK (rotationMatrix (Vec3::Zero()) == Mat3::Identity());
    CHECK ((rotationMatrix (Vec3::UnitZ() * std::numbers::pi / 2.0) * Vec3::UnitX() - Vec3::UnitY()).norm() < 1e-15);
}
