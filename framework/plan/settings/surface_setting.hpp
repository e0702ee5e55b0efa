// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/settings.hpp>

namespace tactus::plan
{

/// Reads a setting of kind `surface`. Throws a Problem, like the functions of setting_parts.hpp.
///
///     {"nodes": [[x, y, z]…], "triangles": [[i, j, k]…], "frames": [[ux, uy, uz]…], "curves": […], "mu": […], "weights": […]}
///     {"mesh": "liver.obj", "curves": […], "mu": […], "weights": […]}
///
/// `curves` lists, for each shape of tool, [node][axis] laws or one [axis] triple for all nodes. `frames` is optional: [node] frames
/// or [shape][node] frames; by default, the frames come from the mesh. `mu` is one ratio for all nodes, [node] ratios, or a list with
/// one of these for each shape. A ratio is a number, a law of the depth, or {"curve": [[depth…], [ratio…]]}. `weights` is optional and
/// mixes the shapes into tools: for each tool, [node][shape] shares, or one list of [shape] shares for all nodes.
std::shared_ptr<const Surface> surfaceFrom (const Json&, const Files&, const std::string& key);

}   // namespace tactus::plan
