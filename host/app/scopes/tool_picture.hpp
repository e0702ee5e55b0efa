// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trace_window.hpp"

#include <tactus/kit/vec3.hpp>

#include <functional>

namespace tactus::host
{

using Signals = std::function<TraceList (const std::string& port)>;

/// A friction node at one moment, as in Fig. 4 of the chapter: the tool is attached to an anchor (w in the figure, c in the node's code) by
/// a bristle that is stretched by the deflection. Once the bristle is as long as d_max, the tool drags the anchor along.
struct ToolPicture
{
    Vec3 tool = Vec3::Zero(), deflection = Vec3::Zero(), force = Vec3::Zero(), normal = Vec3::UnitZ();
    double d_max = 0.0;     ///< 0 if unknown
    double d_stick = 0.0;   ///< breakaway deflection; d_max unless static friction exceeds sliding friction
    std::uint64_t tick = 0;
    int state = 0;   ///< -1 fault, 0 apart, 1 stuck, 2 sliding

    Vec3 anchor() const { return tool - deflection; }
    bool touches() const noexcept { return state > 0; }
};

/// The picture at the newest tick at which all ports are known. Empty if there is none.
std::optional<ToolPicture> toolPicture (const std::string& node, const Signals&);

/// A plane with this normal, seen from above. The x axis, projected onto the plane, points right; if x is along the normal, y does.
struct PlaneView
{
    Vec3 right = Vec3::UnitX(), up = Vec3::UnitY();

    explicit PlaneView (const Vec3& normal);
};

}   // namespace tactus::host
