// SPDX-License-Identifier: MIT
#pragma once

#include "list.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace tactus
{

using Mat3 = Eigen::Matrix3d;

/// The matrix that turns by a rotation vector: about its direction, by its length in rad, right-handed.
inline Mat3 rotationMatrix (const Vec3& rotation) noexcept
{
    const double angle = std::hypot (rotation.x(), rotation.y(), rotation.z());
    return Eigen::AngleAxisd { angle, direction (rotation) }.toRotationMatrix();
}

}   // namespace tactus
