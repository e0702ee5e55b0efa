// SPDX-License-Identifier: MIT
#pragma once

#include "settings.hpp"

namespace tactus::plan
{

/// Reads a setting of kind `surface`. Throws a Problem, like the functions of setting_parts.hpp.
///
///     {"nodes": [[x, y, z]…], "triangles": [[i, j, k]…], "frames": [[ux, uy, uz]…], "curves": […], "mu": […]}
///     {"mesh": "liver.obj", "curves": […], "mu": […]}
///
/// `frames` is optional; by default they come from the mesh. The curves of each tool are [node][axis] laws, or one [axis] triple
/// for all nodes. `mu` holds, for each node, a number or a law of the depth; or one of these for all nodes.
std::shared_ptr<const Surface> surfaceFrom (const Json&, const Files&, const std::string& key);

}   // namespace tactus::plan
