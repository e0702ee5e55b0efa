// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/single/math.hpp>

/// Takes the place of kit/math/math.hpp in single-precision exports.
namespace tactus
{

namespace math = single;

}   // namespace tactus
