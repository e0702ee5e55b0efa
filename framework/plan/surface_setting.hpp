// SPDX-License-Identifier: MIT
#pragma once

#include "settings.hpp"

namespace tactus::plan
{

/// Reads a setting of kind `surface`. Throws a Problem, like the functions of setting_parts.hpp.
///
///     {"nodes": [[x, y, z]…], "triangles": [[i, j, k]…], "frames": [[ux, uy, uz]…], "curves": […], "mu": […], "weights": […]}
///     {"mesh": "liver.obj", "curves": […], "mu": […], "weights": […]}
///
/// The curves of each shape of tool are [node][axis] laws, or one [axis] triple for all nodes. `frames` is optional; by default they
/// come from the mesh: [node] frames, or [shape][node]. `mu` is [node] ratios, one ratio for all, or [shape] of one of these. A ratio
/// is a number, a law of the depth, or {"curve": [[depth…], [ratio…]]}. `weights` is optional; it makes tools out of the
/// shapes: [tool][node][shape] shares, or one list of [shape] shares for all nodes.
std::shared_ptr<const Surface> surfaceFrom (const Json&, const Files&, const std::string& key);

}   // namespace tactus::plan
