// SPDX-License-Identifier: MIT
#pragma once

#include "datasheet.hpp"

#include <numbers>

namespace tactus
{

/// Params that place a frame in the world. A node may use this struct in place of its own Params, as with those of generic.hpp.
struct Frame
{
    Vec3 origin = Vec3::Zero();
    Vec3 rotation = Vec3::Zero();
};

constexpr auto frameOrigin (Vec3 Frame::*member)
{
    return param (member, "origin", sameAs ("in"), "the frame's origin, in the world", { .usual = { -1, 1 } });
}

constexpr auto frameRotation (Vec3 Frame::*member)
{
    return param (member, "rotation", unit::radian, "rotation of the frame: axis times angle", { .usual = { -std::numbers::pi, std::numbers::pi } });
}

}   // namespace tactus
