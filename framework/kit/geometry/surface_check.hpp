// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <string>
#include <vector>

namespace tactus
{

/// The reason why a surface cannot be used, as a sentence. Empty if it can.
std::string problemOf (const Surface&);

/// A warning if a part of a usable surface faces inwards, and therefore attracts or cannot be felt; else empty. It finds triangles that run the other way
/// round than their neighbours, closed meshes that are inside out, and open ones that seem to be. Time: n log n.
std::string wrongSide (const Surface&);

/// A warning that says from which depth an edge of the body is felt as a step: deeper than the radius of the tool, in m. Empty if no edge that bulges
/// out is sharper than `crease` (rad).
std::string sharpEdges (const Surface&, double crease, const std::vector<double>& radii);

}   // namespace tactus
