// SPDX-License-Identifier: MIT
#include "surface_contact.hpp"
#include "downhill.hpp"
#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <limits>

namespace tactus
{

using ContactSample = PlacedSurface::ContactSample;

namespace
{
/// The part of the deflection at right angles to the inward normal.
Vec3 across (const ContactSample& felt) noexcept { return (felt.d.x() * felt.frame.row (0) + felt.d.y() * felt.frame.row (1)).transpose(); }

/// How far the bristle lets the contact point follow the tool.
Vec3 dragged (const ContactSample& felt, const Spot& spot, const Bristle& bristle, const Vec3& from) noexcept
{
    const Vec3 pulled = across (felt);
    if (! (bristle.d_max > 0.0)) return pulled;   // holds nothing

    ContactSample earlier;
    earlier.frame = felt.frame;
    earlier.d = felt.frame * (from - spot.on.point);
    Vec3 d = across (earlier);
    const Vec3 dp = pulled - d;
    const bool lets_go = bristle.letGo (d);
    const auto step = bristle.stretch (d, dp);
    return lets_go || step.slips ? Vec3 { pulled - step.d } : Vec3::Zero();   // without a slip, rounding must not move the contact point
}
}   // namespace

namespace
{
/// How far the contact point may move while the tool moves, in m.
double reach (const ContactSample& felt, const SurfacePath& path) noexcept
{
    constexpr double follows = 2.0;   // relative to the move of the tool; above 1, because on a curved body the contact point is farther out
    if (path.free) return std::numeric_limits<double>::infinity();
    if (path.to == path.from) return 0.0;
    const double depth = felt.d.z(), stretch = math::hypot (felt.d.x(), felt.d.y());
    const double leaves = depth > 0.0 ? stretch / depth : std::numeric_limits<double>::infinity();   // this factor lets the stretch shrink with the depth
    return follows * (path.to - path.from).norm() * std::max (1.0, leaves);
}

Bristle scaled (const Bristle& unit, double bound) noexcept
{
    Bristle bristle = unit;
    bristle.d_max *= bound;
    bristle.d_stick *= bound;
    bristle.d_ba *= bound;
    return bristle;
}

/// The energy that a move of the contact point loses, computed with the tool at one point of its path, given as a share of the path. If this
/// point is the middle of the part of the path on which the contact point moves, the energy equals the integral along the path, to third
/// order in its length. At the end of the path, the energy would be too large: the spring is stretched too far there, by half of the move.
class Loss
{
public:
    Loss (const PlacedSurface& b, const PlacedSurface::Tool& t, const Spot& s, const SurfacePath& p) noexcept : body (b), tool (t), start (s), path (p) {}

    void write (SurfaceStep& step) const noexcept
    {
        step.lost = at (1.0, step.spot);
        const double way = (path.to - path.from).norm(), moved = (step.spot.on.point - start.on.point).norm();
        if (step.ends || ! (moved > 0.0) || ! (way > 0.0)) return;
        double low = 1.0 - 0.5 * std::min (1.0, moved / way), gain = -at (low, step.spot);
        if (gain <= 0.0)
        {
            step.share = low;
            step.lost = -gain;
            return;
        }
        // Computed with the tool there, the move would gain energy. This happens in slides without friction, because they lose
        // none. So find the smallest share without a gain; the loss grows almost linearly with the share.
        constexpr int most = 3;
        for (int i = 0; i < most && step.lost > 0.0; ++i)
        {
            const double share = low + (step.share - low) * std::min (1.0, 1.001 * gain / (gain + step.lost)), lost = at (share, step.spot);
            if (lost >= 0.0)
            {
                step.share = share;
                step.lost = lost;
            }
            else
            {
                low = share;
                gain = -lost;
            }
        }
    }

private:
    double at (double share, const Spot& end) const noexcept
    {
        const Vec3 p = share < 1.0 ? Vec3 { path.from + share * (path.to - path.from) } : path.to;
        return body.feel (start, p, tool).energy - body.feel (end, p, tool).energy;
    }

    const PlacedSurface& body;
    const PlacedSurface::Tool& tool;
    const Spot& start;
    const SurfacePath& path;
};
}   // namespace

SurfaceStep stickOn (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& spot, const Bristle& unit, const SurfacePath& path) noexcept
{
    // Relative; after a slip, the stretch exceeds the bound by more than this only if something holds the contact point back.
    constexpr double past_rim = 1e-3;
    constexpr int most = 16;        // applications of eq. (7); each leaves about a hundredth of the distance to the bound
    constexpr double near = 1e-5;   // relative to the bound; a contact point this near to its bound is not moved again
    SurfaceStep step { .spot = spot, .felt = body.feel (spot, path.to, tool) };
    const Downhill downhill (body, path.to, tool);
    double left = reach (step.felt, path);
    for (int i = 0; i < (path.once ? 1 : most) && left > 0.0 && step.felt.d.z() > 0.0; ++i)
    {
        const double depth = step.felt.d.z();
        const Bristle bristle = scaled (unit, std::max (0.0, body.ratio (step.spot, depth, tool) * depth));
        if (i == 0) left += bristle.d_stick - bristle.d_max;
        Vec3 drag = dragged (step.felt, step.spot, bristle, i == 0 ? path.from : path.to);
        if (drag.isZero (0.0)) break;
        const double length = drag.norm();
        if (i > 0 && length <= near * bristle.d_max) break;
        const bool is_cut = length > left;   // a step that is cut has no meaningful end, so the contact point must not pass a minimum of U
        if (is_cut) drag *= left / length;
        const Vec3 before = step.spot.on.point;
        const bool moves = downhill.along (drag, step.spot, step.felt, is_cut ? Downhill::Reach::lowest : Downhill::Reach::whole);
        step.slips = step.slips || moves;
        left -= (step.spot.on.point - before).norm();
        step.ends = across (step.felt).norm() > bristle.d_stick * (1.0 + past_rim) && body.walk().isBeyondRim (step.spot, path.to);
        if (! moves || step.ends) break;
    }
    step.ends = step.ends || ! (step.felt.d.z() > 0.0);
    if (step.slips) Loss (body, tool, spot, path).write (step);
    return step;
}

SurfaceStep slideOn (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& spot, const SurfacePath& path) noexcept
{
    SurfaceStep step { .spot = spot, .felt = body.feel (spot, path.to, tool), .slips = true };
    const double farthest = reach (step.felt, path);
    if (farthest > 0.0)
    {
        const Downhill downhill (body, path.to, tool);
        const Vec3 inward = step.felt.frame.row (2).transpose(), move = path.to - path.from;
        downhill.along (path.free ? across (step.felt) : Vec3 { move - inward.dot (move) * inward }, step.spot, step.felt);
        downhill.settle (step.spot, step.felt, farthest - (step.spot.on.point - spot.on.point).norm());
    }
    step.ends = ! (step.felt.d.z() > 0.0) || body.walk().isBeyondRim (step.spot, path.to);
    if (farthest > 0.0) Loss (body, tool, spot, path).write (step);
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
