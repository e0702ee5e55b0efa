// SPDX-License-Identifier: MIT
#pragma once

#include "placed_surface.hpp"

namespace tactus
{

/// Moves the contact point c of a tool at p over a surface, so that the stored energy U (c, p) falls.
///
/// With c fixed, the force is the gradient of U with respect to p. So energy can be generated only by a move of c that raises U. If
/// every move lowers U, the contact is passive for every mesh, frame, curve and mu.
class Downhill
{
public:
    Downhill (const PlacedSurface& surface, const Vec3& position, const PlacedSurface::Tool& by) noexcept : body (surface), p (position), tool (by) {}

    /// How far `along` moves the contact point.
    enum class Reach
    {
        whole,   ///< the whole step if U is not higher at its end, even if U is lower on the way
        lowest   ///< to where U is lowest on the way
    };

    /// Moves a contact point by a step, and back onto the mesh. If U would rise, it moves only a part of the way or not at all. Returns
    /// false if the contact point did not move. Takes the response at the spot, and updates it. [any thread]
    bool along (const Vec3& step, Spot&, PlacedSurface::ContactSample&, Reach = Reach::whole) const noexcept;

    /// Moves a contact point down to a local minimum of U. A path longer than `longest` (m) ends after this length. At the minimum,
    /// dU/dc is 0, or the minimum is on an edge, where the slopes on both sides rise. [any thread]
    void settle (Spot&, PlacedSurface::ContactSample&, double longest) const noexcept;

private:
    class Patch;

    void descend (Spot&, PlacedSurface::ContactSample&, double& left) const noexcept;

    const PlacedSurface& body;
    const Vec3& p;
    const PlacedSurface::Tool& tool;
};

}   // namespace tactus
