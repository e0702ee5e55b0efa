// SPDX-License-Identifier: MIT
#pragma once

#include "mirrored_grid.hpp"

#include <tactus/kit/assets.hpp>

namespace tactus
{

/// The step of rounded heights, in their unit, if it would be felt; else 0. It is felt if most neighbours that differ do so by one step, and others are
/// level. For example, a picture with 8 bits has 256 heights, so its slopes are stairs. Time: n log n. [main thread]
double feltStep (const Grid&);

/// The heights after three averages over about this length, in m, in both directions. Slopes stay, and detail shorter than the length goes. The map is
/// mirrored at its rim. Time: linear in the number of points. [main thread]
MirroredGrid smoothedOver (MirroredGrid, double length);

}   // namespace tactus
