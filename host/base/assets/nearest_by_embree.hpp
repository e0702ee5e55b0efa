// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/nearest_triangle.hpp>

#include <memory>

namespace tactus::host
{

/// Quickly finds the nearest triangle of a large mesh: exactly the one that nearestOfAll finds. Embree narrows the search
/// down in single precision; candidates are compared in double precision. The mesh needs at least one triangle. [main thread]
std::unique_ptr<NearestTriangle> nearestByEmbree (std::shared_ptr<const Mesh> mesh);

}   // namespace tactus::host
