// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/single/extended.hpp>
#include <tactus/kit/vec3.hpp>

/// Takes the place of kit/fine.hpp in single-precision exports.
namespace tactus
{

using Fine = Extended;
using Position = Eigen::Matrix<Extended, 3, 1>;

// Not for expressions, which become a Vec3.
template <std::same_as<Position> P>
bool isFinite (const P& v) noexcept
{
    return isFinite (v.x()) && isFinite (v.y()) && isFinite (v.z());
}

template <std::same_as<Position> P>
P finiteOrZero (const P& v) noexcept
{
    return isFinite (v) ? v : P (P::Zero());
}

}   // namespace tactus
