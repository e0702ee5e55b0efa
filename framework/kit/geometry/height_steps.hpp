// SPDX-License-Identifier: MIT
#pragma once

#include "mirrored_grid.hpp"

#include <tactus/kit/assets.hpp>

namespace tactus
{

/// The step of heights that were rounded, in their unit, if it would be felt: if most neighbours that differ do so by one step, and others are
/// level. A picture with 8 bits has 256 heights, so a slope in it is a stair. 0 if no such step is found. Time: n log n. [main thread]
double feltStep (const Grid&);

/// The heights averaged three times over about this length in both directions, in m. Slopes stay: only what is shorter than the length goes. At
/// its rim the map is continued by mirroring. Time: linear in the number of points. [main thread]
MirroredGrid smoothedOver (MirroredGrid, double length);

}   // namespace tactus
