// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/nearest_triangle.hpp>

#include <memory>

namespace tactus::host
{

/// Finds the nearest triangle of a large mesh fast, the very one that nearestOfAll finds. Embree narrows the search
/// down in float; what is near is compared in double. The mesh needs at least one triangle. [main thread]
std::unique_ptr<NearestTriangle> nearestByEmbree (std::shared_ptr<const Mesh> mesh);

}   // namespace tactus::host
