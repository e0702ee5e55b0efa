// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <memory>
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

/// A warning if the mesh is too coarse for the edges that `crease` (rad) calls round: the smooth surface through its nodes leans far from its triangles
/// there. Empty if not. It builds the surface only if triangles of one face meet at more than 45 degrees.
std::string coarseFaces (const Surface&, double crease);

/// A warning if the force along the normal, at a depth of 1 mm, changes over fewer than three cells of the mesh, so that the tool feels a slower change;
/// else empty.
std::string abruptStiffness (const Surface&);

/// The warnings about a surface, from wrongSide or else coarseFaces and sharpEdges, and from abruptStiffness. Empty if there are none. [any thread]
std::string faultsOf (const Surface&, double crease, const std::vector<double>& radii);

}   // namespace tactus
