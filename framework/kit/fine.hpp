// SPDX-License-Identifier: MIT
#pragma once

#include "vec3.hpp"

namespace tactus
{

/// Types for numbers that need more digits than a float has: a position, and a time that grows without end. Steps of a float are 7.5 nm at 0.1 m,
/// which a hand feels as noise. In a single-precision export, all other numbers are floats, and these are sums of two floats
/// (kit/single/extended.hpp). Differences of nearby ones may be stored as double or Vec3.
using Fine = double;
using Position = Vec3;

}   // namespace tactus
