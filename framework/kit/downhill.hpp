// SPDX-License-Identifier: MIT
#pragma once

#include "placed_surface.hpp"

namespace tactus
{

/// Moves the contact point c of a tool at p over a surface, so that the stored energy U (c, p) falls.
///
/// With c fixed, the force is the gradient of U with respect to p. Energy can therefore be generated only where c moves, by a rise
/// of U. If every move lowers U, the contact is passive for every mesh, frame, curve and mu.
class Downhill
{
public:
    Downhill (const PlacedSurface& surface, const Vec3& position, const PlacedSurface::Tool& by) noexcept : body (surface), p (position), tool (by) {}

    /// Moves a contact point along a step and back onto the mesh; only a part of the way, or not at all, if U would rise. Returns
    /// false if the contact point did not move. `felt` is what is felt at the spot, before and after. [any thread]
    bool along (const Vec3& step, Spot&, PlacedSurface::Felt&) const noexcept;

    /// Moves a contact point down to a local minimum of U. There dU/dc is 0, or the minimum is on an edge, where the slopes on both
    /// sides rise. [any thread]
    void settle (Spot&, PlacedSurface::Felt&) const noexcept;

private:
    class Patch;

    void descend (Spot&, PlacedSurface::Felt&) const noexcept;

    const PlacedSurface& body;
    const Vec3& p;
    const PlacedSurface::Tool& tool;
};

}   // namespace tactus
