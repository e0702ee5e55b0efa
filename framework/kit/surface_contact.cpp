// SPDX-License-Identifier: MIT
#include "surface_contact.hpp"
#include "downhill.hpp"

#include <algorithm>
#include <cmath>

namespace tactus
{

using Felt = PlacedSurface::Felt;

namespace
{
/// The part of the deflection across the inward normal.
Vec3 across (const Felt& felt) noexcept { return (felt.d.x() * felt.frame.row (0) + felt.d.y() * felt.frame.row (1)).transpose(); }

/// How far the adhesion function lets the contact point follow the tool.
Vec3 dragged (const Felt& felt, const Spot& spot, const Adhesion& adhesion, double bound, const Vec3& from) noexcept
{
    // Relative; a steady slip ends exactly on the bound, so without this tolerance rounding would make the contact chatter.
    constexpr double guard = 1e-9;
    if (adhesion.kind == Adhesion::Kind::stick && std::hypot (felt.d.x(), felt.d.y()) <= adhesion.d_stick * bound * (1.0 + guard)) return Vec3::Zero();

    Felt earlier;
    earlier.frame = felt.frame;
    earlier.d = felt.frame * (from - spot.on.point);
    const Vec3 pulled = across (felt);
    return pulled - adhesion.stretch (across (earlier), pulled, bound);
}
}   // namespace

SurfaceStep stickOn (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& spot, const Adhesion& adhesion, const Vec3& from,
                     const Vec3& to) noexcept
{
    // Relative; after a slip, the stretch exceeds the bound by more than this only if something holds the contact point back.
    constexpr double past_rim = 1e-3;
    SurfaceStep step { .spot = spot, .felt = body.feel (spot, to, tool) };
    if (step.felt.d.z() > 0.0)
    {
        const double bound = std::max (0.0, body.ratio (spot, step.felt.d.z(), tool) * step.felt.d.z());
        const Vec3 drag = dragged (step.felt, spot, adhesion, bound, from);
        if (! drag.isZero (0.0))
        {
            const double before = step.felt.energy;
            step.slips = Downhill (body, to, tool).along (drag, step.spot, step.felt);
            step.lost = before - step.felt.energy;
            step.ends = across (step.felt).norm() > adhesion.d_stick * bound * (1.0 + past_rim) && body.walk().isBeyondRim (step.spot, to);
        }
    }
    step.ends = step.ends || ! (step.felt.d.z() > 0.0);
    return step;
}

SurfaceStep slideOn (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& spot, const Vec3& from, const Vec3& to) noexcept
{
    SurfaceStep step { .spot = spot, .felt = body.feel (spot, to, tool), .slips = true };
    if (to != from)
    {
        const double before = step.felt.energy;
        const Downhill downhill (body, to, tool);
        downhill.along (across (step.felt), step.spot, step.felt);
        downhill.settle (step.spot, step.felt);
        step.lost = before - step.felt.energy;
    }
    step.ends = ! (step.felt.d.z() > 0.0) || body.walk().isBeyondRim (step.spot, to);
    return step;
}

SurfaceStep projectOn (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& spot, const Vec3& to) noexcept
{
    SurfaceStep step { .spot = body.walk().nearest (spot.triangle, to), .slips = true };
    step.felt = body.feel (step.spot, to, tool);
    step.ends = ! (step.felt.d.z() > 0.0) || body.walk().isBeyondRim (step.spot, to);
    return step;
}

}   // namespace tactus
