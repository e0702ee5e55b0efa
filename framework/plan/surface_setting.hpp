// SPDX-License-Identifier: MIT
#pragma once

#include "settings.hpp"

namespace tactus::plan
{

/// Reads a setting of kind `surface`; throws a Problem as setting_parts.hpp has it.
///
///     {"nodes": [[x, y, z]…], "triangles": [[i, j, k]…], "frames": [[ux, uy, uz]…], "curves": […], "mu": […]}
///     {"mesh": "liver.obj", "curves": […], "mu": […]}
///
/// Frames may be left out, then they come from the mesh. Curves of each tool are [node][axis] laws, or one [axis] triple
/// for all nodes; mu holds a number or a law of the depth for each node, or one for all.
std::shared_ptr<const Surface> surfaceFrom (const Json&, const Files&, const std::string& key);

}   // namespace tactus::plan
