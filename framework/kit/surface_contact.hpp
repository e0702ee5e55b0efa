// SPDX-License-Identifier: MIT
#pragma once

#include "adhesion.hpp"
#include "placed_surface.hpp"

namespace tactus
{

/// What a step of the tool does to its contact point.
struct SurfaceStep
{
    Spot spot {};
    PlacedSurface::Felt felt {};   ///< at the spot
    double lost = 0.0;             ///< energy that the move of the contact point dissipates, J; never negative
    bool slips = false;
    bool ends = false;   ///< the tool has left the surface
};

/// A contact point that sticks within its bound, eq. (7), and yields by an adhesion function, while the tool goes from one position to
/// the next. d_max of the function is the bound. [any thread]
SurfaceStep stickOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Adhesion&, const Vec3& from, const Vec3& to) noexcept;

/// A contact point that slides down to a local minimum of the stored energy. A tool that does not move does not move its contact
/// point. [any thread]
SurfaceStep slideOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Vec3& from, const Vec3& to) noexcept;

/// A contact point that follows the tool as its projection. What the stored energy gains or loses by this is work of the force
/// PlacedSurface::slope(). [any thread]
SurfaceStep projectOn (const PlacedSurface&, const PlacedSurface::Tool&, const Spot&, const Vec3& to) noexcept;

}   // namespace tactus
