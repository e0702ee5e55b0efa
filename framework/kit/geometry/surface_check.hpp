// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <memory>
#include <string>

namespace tactus
{

/// The reason why a surface cannot be used, as a sentence. Empty if it can.
std::string problemOf (const Surface&);

/// A warning if a part of a usable surface faces inwards, and therefore attracts or cannot be felt; or empty: triangles that run the other way round
/// than their neighbours, a closed mesh that is inside out, and an open one that seems to be. Time: n log n.
std::string wrongSide (const Surface&);

/// A warning if the force on a flat face differs much from its law, because the frames of its corners turn: or empty. A block of 8 points, whose
/// frames are means over its edges, feels like a dome. The sentence says by how much, from presses into the faces whose frames turn most. Bodies without
/// an edge that turns by more than 35 degrees count as round. `scale` is the length of one unit of the mesh, in m.
std::string unevenForce (const std::shared_ptr<const Surface>&, double scale);

}   // namespace tactus
