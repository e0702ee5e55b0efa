// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/rotation.hpp>

#include <cmath>

namespace tactus::host
{

/// The rotation vector of a matrix, by the short way round. The matrix may have the small errors of a device.
inline Vec3 rotationOf (const Mat3& m)
{
    auto q = Quaternion (m).normalized();
    if (q.w() < 0.0) q.coeffs() *= -1.0;
    const double sine = q.vec().norm();
    return q.vec() * (sine > 1e-12 ? 2.0 * std::atan2 (sine, q.w()) / sine : 2.0);
}

}   // namespace tactus::host
