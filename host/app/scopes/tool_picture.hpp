// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "look_at.hpp"

#include <framework/list.hpp>

#include <functional>

namespace tactus::host
{

using Signals = std::function<TraceList (const std::string& port)>;

/// A friction node at one moment, as Fig. 4 of the chapter draws it: the tool holds on to an anchor, w there and c here, by a
/// bristle that is stretched by the deflection, and drags the anchor along once that is as long as d_max.
struct ToolPicture
{
    Vec3 tool = Vec3::Zero(), deflection = Vec3::Zero(), force = Vec3::Zero(), normal = Vec3::UnitZ();
    double d_max = 0.0;     ///< 0 if nobody says
    double d_stick = 0.0;   ///< where it lets go; d_max unless it sticks more than it slides
    std::uint64_t tick = 0;
    int state = 0;   ///< -1 fault, 0 apart, 1 stuck, 2 sliding

    Vec3 anchor() const { return tool - deflection; }
    bool touches() const noexcept { return state > 0; }
};

/// Of the newest tick on which all is known; nothing if there is none.
std::optional<ToolPicture> toolPicture (const std::string& node, const Signals&);

/// From above a plane with this normal: x to the right where there is an x in the plane, else y.
struct PlaneView
{
    Vec3 right = Vec3::UnitX(), up = Vec3::UnitY();

    explicit PlaneView (const Vec3& normal);
};

}   // namespace tactus::host
