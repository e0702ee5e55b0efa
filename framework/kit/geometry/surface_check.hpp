// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <memory>
#include <string>

namespace tactus
{

/// The reason why a surface cannot be used, as a sentence. Empty if it can.
std::string problemOf (const Surface&);

/// A warning if a part of a usable surface faces inwards, and therefore attracts or cannot be felt; else empty. It finds triangles that run the other way
/// round than their neighbours, closed meshes that are inside out, and open ones that seem to be. Time: n log n.
std::string wrongSide (const Surface&);

/// A warning if the force on a flat face differs much from its law, because the frames at its corners turn; else empty. For example, a block of 8 points
/// feels like a dome, because its frames are means over its edges. The warning gives the error of the force, from presses into the faces whose frames turn
/// most. A body without an edge of more than 35 degrees counts as round. `scale` is the length of one unit of the mesh, in m.
std::string unevenForce (const std::shared_ptr<const Surface>&, double scale);

}   // namespace tactus
