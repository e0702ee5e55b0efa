// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>

#include <vector>

namespace tactus
{

class MeshWalk;

/// The face of each triangle, counted from 0. Triangles that meet at a larger angle than `crease` (rad) belong to two faces, unless there is a way
/// around. [main thread]
std::vector<int> facesOf (const Mesh&, const MeshWalk&, double crease);

}   // namespace tactus
