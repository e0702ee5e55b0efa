// SPDX-License-Identifier: MIT
#pragma once

#include "list.hpp"

#include <cmath>

namespace tactus
{

/// How long a vector is; right for the largest and smallest, too. Scaling it first, as Eigen's stableNorm does, costs
/// several times as much, and is needed only where a square would leave the range of doubles.
inline double length (const Vec3& v) noexcept
{
    const double square = v.squaredNorm();
    return square > 1e-280 && square < 1e280 ? std::sqrt (square) : v.stableNorm();
}

}   // namespace tactus
