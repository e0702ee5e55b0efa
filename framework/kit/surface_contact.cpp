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
/// The part of the deflection at right angles to the inward normal.
Vec3 across (const Felt& felt) noexcept { return (felt.d.x() * felt.frame.row (0) + felt.d.y() * felt.frame.row (1)).transpose(); }

/// How far the bristle lets the contact point follow the tool.
Vec3 dragged (const Felt& felt, const Spot& spot, const Bristle& bristle, const Vec3& from) noexcept
{
    const Vec3 pulled = across (felt);
    if (! (bristle.d_max > 0.0)) return pulled;   // holds nothing

    Felt earlier;
    earlier.frame = felt.frame;
    earlier.d = felt.frame * (from - spot.on.point);
    Vec3 d = across (earlier);
    const Vec3 dp = pulled - d;
    const bool lets_go = bristle.letGo (d);
    const auto step = bristle.stretch (d, dp);
    return lets_go || step.slips ? Vec3 { pulled - step.d } : Vec3::Zero();   // without a slip, rounding must not move the contact point
}
}   // namespace

SurfaceStep stickOn (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& spot, const Bristle& unit, const Vec3& from,
                     const Vec3& to) noexcept
{
    // Relative; after a slip, the stretch exceeds the bound by more than this only if something holds the contact point back.
    constexpr double past_rim = 1e-3;
    SurfaceStep step { .spot = spot, .felt = body.feel (spot, to, tool) };
    if (step.felt.d.z() > 0.0)
    {
        const double bound = std::max (0.0, body.ratio (spot, step.felt.d.z(), tool) * step.felt.d.z());
        Bristle bristle = unit;
        bristle.d_max *= bound;
        bristle.d_stick *= bound;
        bristle.d_ba *= bound;
        const Vec3 drag = dragged (step.felt, spot, bristle, from);
        if (! drag.isZero (0.0))
        {
            const double before = step.felt.energy;
            step.slips = Downhill (body, to, tool).along (drag, step.spot, step.felt);
            step.lost = before - step.felt.energy;
            step.ends = across (step.felt).norm() > bristle.d_stick * (1.0 + past_rim) && body.walk().isBeyondRim (step.spot, to);
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
