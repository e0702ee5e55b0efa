// SPDX-License-Identifier: MIT
#pragma once

#include "bristle.hpp"
#include "placed_surface.hpp"

namespace tactus
{

/// What a step of the tool does to its contact point.
struct SurfaceStep
{
    Spot spot {};
    PlacedSurface::Felt felt {};   ///< what the tool feels at the spot
    double lost = 0.0;             ///< energy that the move of the contact point dissipates, J; never negative
    bool slips = false;
    bool ends = false;   ///< the tool has left the surface
};

/// Moves a contact point that sticks within its bound, eq. (7), and yields as the bristle does, while the tool goes from one
/// position to the next. The bristle has a d_max of 1, and its lengths are scaled by the bound. [any thread]
SurfaceStep stickOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Bristle&, const Vec3& from, const Vec3& to) noexcept;

/// Moves a contact point that slides down to a local minimum of the stored energy. If the tool does not move, neither does the
/// contact point. [any thread]
SurfaceStep slideOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Vec3& from, const Vec3& to) noexcept;

/// Moves a contact point that follows the tool as its projection. The change of the stored energy by this move is the work of the
/// force PlacedSurface::slope(). [any thread]
SurfaceStep projectOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Vec3& to) noexcept;

}   // namespace tactus
