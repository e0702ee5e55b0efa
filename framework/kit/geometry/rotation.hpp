// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/vec3.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tactus
{

using Mat3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaternion<double, Eigen::DontAlign>;   // has the same layout whatever the flags of the compiler are

/// The matrix of a rotation vector: right-handed about its direction, by its length in rad.
inline Mat3 rotationMatrix (const Vec3& rotation) noexcept
{
    // R = cos I + sin [a]x + (1 - cos) a a^T (Rodrigues), written out because Eigen's AngleAxis calls the C library.
    const auto [sine, cosine] = math::sinCos (math::hypot (rotation.x(), rotation.y(), rotation.z()));
    const Vec3 a = direction (rotation), s = sine * a, c = (1.0 - cosine) * a;
    Mat3 matrix;
    matrix << c.x() * a.x() + cosine, c.x() * a.y() - s.z(), c.x() * a.z() + s.y(),
        c.x() * a.y() + s.z(), c.y() * a.y() + cosine, c.y() * a.z() - s.x(),
        c.x() * a.z() - s.y(), c.y() * a.z() + s.x(), c.z() * a.z() + cosine;
    return matrix;
}

/// A unit vector at right angles to the unit vector v: z projected onto the plane of v, or x if v is within 45 degrees of z.
inline Vec3 perpendicularTo (const Vec3& v) noexcept
{
    const Vec3 start = 2.0 * v.z() * v.z() < 1.0 ? Vec3::UnitZ() : Vec3::UnitX();
    return (start - start.dot (v) * v).normalized();
}

/// The shortest rotation that turns the direction of `from` into the direction of `to`. Neither may be 0.
///
/// The same bits as Eigen's FromTwoVectors, except for opposite directions. There Eigen finds the axis by a singular value
/// decomposition, which takes ten seconds to compile in every file that includes it. Here opposite directions (within
/// 1.4e-6 rad) take a half turn about perpendicularTo (from) and the short rotation from there to `to`.
///
/// As in Eigen, the error grows as the directions become opposite: about 1e-15 / (1 + cosine of the angle between them).
inline Quaternion shortestRotation (const Vec3& from, const Vec3& to) noexcept
{
    const Vec3 v0 = from.normalized();
    const Vec3 v1 = to.normalized();
    const auto arc = [] (const Vec3& a, const Vec3& b, double cosine) {
        const Vec3 axis = a.cross (b);
        const double s = std::sqrt ((1.0 + cosine) * 2.0), inverse = 1.0 / s;
        return Quaternion { s * 0.5, axis.x() * inverse, axis.y() * inverse, axis.z() * inverse };
    };

    const double cosine = v1.dot (v0);
    if (! (cosine < -1.0 + margin (1e-12))) return arc (v0, v1, cosine);

    const Vec3 axis = perpendicularTo (v0);
    return arc (-v0, v1, -cosine) * Quaternion { 0.0, axis.x(), axis.y(), axis.z() };
}

}   // namespace tactus
