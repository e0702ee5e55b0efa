// SPDX-License-Identifier: MIT
#pragma once

#include "placed_surface.hpp"
#include <tactus/kit/bristle.hpp>

namespace tactus
{

/// A straight move of the tool, and how its contact point may move during it.
struct SurfacePath
{
    Vec3 from, to;
    bool free = false;   ///< the contact point may move any distance, as when a contact begins
    bool once = false;   ///< eq. (7) is applied once, instead of until the contact point is within its bound
};

// If the next minimum of U is far from a contact point, the force would step if the contact point went all the way at once. So in one move it
// goes at most twice as far as the tool, or farther if the contact would otherwise still be stretched when the tool leaves; a collapse of
// stick-slip comes on top. If the tool does not move, neither does the contact point.

/// What a step of the tool does to its contact point.
struct SurfaceStep
{
    Spot spot {};
    PlacedSurface::ContactSample felt {};   ///< what the tool feels at the spot
    double share = 1.0;                     ///< where on its path the tool is taken to be when the contact point moves: 0 at the start, 1 at the end
    double lost = 0.0;                      ///< energy that the move of the contact point dissipates with the tool there, J; never negative
    bool slips = false;
    bool ends = false;   ///< the tool has left the surface
};

/// Moves a contact point that sticks within its bound, eq. (7), and yields as the bristle does. The bristle has a d_max of 1, and
/// its lengths are scaled by the bound. [any thread]
SurfaceStep stickOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Bristle&, const SurfacePath&) noexcept;

/// Moves a contact point that slides down to a local minimum of the stored energy. [any thread]
SurfaceStep slideOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const SurfacePath&) noexcept;

/// Moves a contact point that follows the tool as its projection. The change of the stored energy by this move is the work of the
/// force PlacedSurface::slope(). [any thread]
SurfaceStep projectOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Vec3& to) noexcept;

}   // namespace tactus
