// SPDX-License-Identifier: MIT
#pragma once

#include "placed_surface.hpp"
#include <tactus/kit/bristle.hpp>

#include <optional>

namespace tactus
{

/// The contact of a tool with a surface, as nodes/deform/surface.hpp defines it: its foot, and the anchor that its sideways stretch is counted
/// from.
struct SurfaceTouch
{
    PlacedSurface::Foot foot {};   ///< no face while apart
    Vec3 anchor = Vec3::Zero();
    bool frictionless = false;   ///< the anchor is the foot
    bool held = false;           ///< the tool has no foot near the last one, so the contact keeps the last one
};

/// A contact, and what the tool feels there.
struct SurfaceSample
{
    SurfaceTouch touch {};
    PlacedSurface::ContactSample felt {};
    bool left = false;   ///< the foot has passed the rim of an open mesh
    int beyond = -1;     ///< a triangle of the face that the foot has passed; -1: none
};

/// A contact with its foot moved along while its tool goes from one point to another. The foot moves without a jump, or it is held. [any thread]
SurfaceSample followed (const PlacedSurface&, const PlacedSurface::Tool&, const SurfaceTouch&, const Vec3& from, const Vec3& to) noexcept;

/// The force on the tool, minus the gradient of the stored energy with respect to its position, with the anchor fixed. [any thread]
Vec3 forceOf (const PlacedSurface&, const PlacedSurface::Tool&, const SurfaceSample&, const Vec3& p) noexcept;

/// The effect of a step of the tool on its contact.
struct SurfaceStep
{
    SurfaceSample after {};
    double share = 1.0;   ///< where on its path the tool is taken to be when the anchor moves: 0 at the start, 1 at the end
    double lost = 0.0;    ///< energy that the move of the anchor dissipates with the tool there, J; never negative
    bool slips = false;
    bool ends = false;   ///< the tool has left the surface
};

/// Moves a contact along with its tool. The anchor sticks within its bound, eq. (7), and yields as the bristle does. The bristle has a d_max of
/// 1, and its lengths are scaled by the bound. [any thread]
SurfaceStep stepped (const PlacedSurface&, const PlacedSurface::Tool&, const SurfaceTouch&, const Bristle&, const Vec3& from, const Vec3& to) noexcept;

/// A contact at the moment when it begins.
struct SurfaceEntry
{
    SurfaceTouch touch {};
    Vec3 tool = Vec3::Zero();   ///< where the tool is then
};

/// The place on the straight way of a tool where its depth over a foot goes from negative to positive. The search begins at a share of the way from
/// 0 to 1. None if there is no such place near. [any thread]
std::optional<SurfaceEntry> entryOf (const PlacedSurface&, const PlacedSurface::Tool&, const PlacedSurface::Foot&, double share, const Vec3& from,
                                     const Vec3& to, bool frictionless) noexcept;

/// A contact at the foot of a tool, without stretch. No face if there is no foot, or if the tool is outside. [any thread]
SurfaceSample begun (const PlacedSurface&, const PlacedSurface::Tool&, const PlacedSurface::Foot& near, bool frictionless, const Vec3& p) noexcept;

}   // namespace tactus
