// SPDX-License-Identifier: MIT
#pragma once

#include "nearest_triangle.hpp"

#include <memory>

namespace tactus
{

/// Finds the nearest triangle of a large mesh with a tree of boxes: exactly the one that nearestOfAll finds. A search looks at some hundred boxes,
/// however large the mesh is, and allocates nothing. The mesh needs at least one triangle. [main thread]
std::unique_ptr<NearestTriangle> nearestByBoxes (std::shared_ptr<const Mesh> mesh);

}   // namespace tactus
