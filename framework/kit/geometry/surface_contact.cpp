// SPDX-License-Identifier: MIT
#include "surface_contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tactus
{

using Foot = PlacedSurface::Foot;

namespace
{
using Vec2 = Eigen::Vector2d;

const Vec3* anchorOf (const SurfaceTouch& touch) noexcept { return touch.frictionless ? nullptr : &touch.anchor; }

/// Puts the anchor where the stretch from the foot is s, along u^x and u^y. An anchor as deep as the tool lets the stretch grow as fast as the tool
/// moves, whatever the curvature: so the drag is that of a flat body, and does not step where the tool rolls onto an edge. So the anchor follows the
/// tool by `deeper`, the rise of its depth in this step, and the rest of its height falls in the same ratio as the stretch: a short slip changes
/// little.
void stretch (SurfaceSample& sample, const Vec2& s, double deeper) noexcept
{
    const Vec3 before = sample.felt.frame * (sample.felt.place - sample.touch.anchor);
    const double length = before.head<2>().norm(), ratio = length > 0.0 ? std::min (1.0, s.norm() / length) : 0.0, depth = sample.felt.d.z();
    sample.touch.anchor = sample.felt.place - sample.felt.frame.transpose() * Vec3 (s.x(), s.y(), (before.z() + depth - deeper) * ratio - depth);
}

SurfaceSample sampled (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceTouch& touch) noexcept
{
    return { touch, body.feel (touch.foot, anchorOf (touch), tool) };
}

Bristle scaled (const Bristle& unit, double bound) noexcept
{
    Bristle bristle = unit;
    bristle.d_max *= bound;
    bristle.d_stick *= bound;
    bristle.d_ba *= bound;
    return bristle;
}

/// The stretch that the bristle leaves, if the contact slips.
std::optional<Vec2> slipped (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceSample& now, const Foot& before,
                             const Bristle& unit) noexcept
{
    const Vec2 pulled = now.felt.d.head<2>();
    const double bound = std::max (0.0, body.ratio (now.touch.foot, now.felt.d.z(), tool) * now.felt.d.z());
    if (! (bound > 0.0)) return pulled.isZero (0.0) ? std::nullopt : std::optional<Vec2> (Vec2::Zero());
    const Bristle bristle = scaled (unit, bound);
    const Vec2 earlier = (now.felt.frame * (PlacedSurface::placeOf (before, tool) - now.touch.anchor)).head<2>();
    Vec3 d (earlier.x(), earlier.y(), 0.0);
    const Vec3 dp (pulled.x() - d.x(), pulled.y() - d.y(), 0.0);
    const bool lets_go = bristle.letGo (d);
    const auto step = bristle.stretch (d, dp);
    if (! lets_go && ! step.slips) return {};
    return step.d.head<2>();
}

/// The straight way of a tool during a step, and the contact on it.
class Way
{
public:
    Way (const PlacedSurface& b, const PlacedSurface::Tool& t, const Vec3& f, const Vec3& e) noexcept : body (b), tool (t), from (f), to (e) {}

    Vec3 at (double share) const noexcept { return share < 1.0 ? Vec3 { from + share * (to - from) } : to; }
    SurfaceSample follow (const SurfaceTouch& touch, double share) const noexcept { return followed (body, tool, touch, from, at (share)); }

    /// Sets the place where the tool is taken to be when the anchor moves: the middle of the part of the way on which it moves. At the end of the way
    /// the springs are stretched too far, by half of the move, so the loss would grow with the length of the ticks.
    void lose (SurfaceStep& step, const SurfaceTouch& start, const SurfaceSample& pulled) const noexcept
    {
        const auto sideways = pulled.felt.frame.topRows<2>();
        const Vec2 dc = sideways * (step.after.touch.anchor - start.anchor), dr = sideways * (to - from);
        const double forward = dc.dot (dr), back = forward > 0.0 ? std::min (1.0, 0.5 * dc.squaredNorm() / forward) : 0.0;
        for (const double less : { 1e-9, 1e-4, 1e-2, 0.1, 1.0 })   // nearer to the end if need be
        {
            step.share = 1.0 - back * (1.0 - less);
            const SurfaceTouch slipped { .foot = pulled.touch.foot, .anchor = step.after.touch.anchor };
            step.lost = follow (start, step.share).felt.energy - followed (body, tool, slipped, to, at (step.share)).felt.energy;
            if (step.lost >= 0.0) return;
        }
        step.lost = 0.0;   // it was negative by rounding
    }

private:
    const PlacedSurface& body;
    const PlacedSurface::Tool& tool;
    const Vec3 &from, &to;
};
}   // namespace

SurfaceSample followed (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceTouch& touch, const Vec3& from, const Vec3& to) noexcept
{
    constexpr double farthest = 25.0;   // the largest move of a foot, relative to that of its tool, that is not a jump
    if (to == from) return sampled (body, tool, touch);
    SurfaceTouch there = touch;
    const Foot foot = body.smooth().followed (touch.foot, to);
    there.held = ! foot.found || foot.beyond >= 0 || touch.held || (foot.point - touch.foot.point).norm() > farthest * (to - from).norm();
    if (there.held)
        there.foot.distance = (to - touch.foot.point).dot (touch.foot.normal);
    else
        there.foot = foot;
    SurfaceSample sample = sampled (body, tool, there);
    sample.left = foot.left;
    sample.beyond = foot.beyond;
    return sample;
}

Vec3 forceOf (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceSample& sample, const Vec3& p) noexcept
{
    const auto& [touch, felt, left, beyond] = sample;
    return touch.held ? Vec3 { felt.f.z() * touch.foot.normal } : body.forceOf (touch.foot, felt, p, tool);
}

SurfaceStep stepped (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceTouch& start, const Bristle& unit, const Vec3& from,
                     const Vec3& to) noexcept
{
    const Way way (body, tool, from, to);
    SurfaceStep step { .after = way.follow (start, 1.0), .slips = start.frictionless };
    if (to == from) return step;
    body.smooth().know (step.after.touch.foot);
    if (step.after.left)   // over the rim
    {
        step.share = 0.0;
        step.lost = sampled (body, tool, start).felt.energy;
        step.ends = true;
        return step;
    }
    if (step.after.touch.held)
    {
        // Another foot: far away, or on the next face.
        const auto& smooth = body.smooth();
        const int beyond = step.after.beyond;
        const Foot foot = smooth.followed (beyond < 0 ? start.foot : smooth.footOn (beyond, start.foot.point), to);
        if (foot.found && foot.beyond < 0 && ! foot.left)
        {
            SurfaceSample there = sampled (body, tool, { .foot = foot, .frictionless = start.frictionless });
            const Vec3 d = step.after.felt.d;   // the stretch is carried along
            there.touch.anchor = there.felt.place - there.felt.frame.transpose() * Vec3 (d.x(), d.y(), -there.felt.d.z());
            if (! start.frictionless) there.felt = body.stretched (there.felt, foot, there.touch.anchor, tool);
            if (! (there.felt.d.z() > 0.0)) there.felt.energy = 0.0;
            if (there.felt.energy <= step.after.felt.energy)
            {
                step.lost = step.after.felt.energy - there.felt.energy;
                step.after = there;
            }
        }
    }
    const bool jumped = step.lost > 0.0 || step.after.touch.held;
    if (! (step.after.felt.d.z() > 0.0))
    {
        step.ends = true;
        if (step.lost > 0.0) return step;
        const double before = sampled (body, tool, start).felt.d.z();
        step.share = before > 0.0 ? before / (before - step.after.felt.d.z()) : 0.0;
        step.lost = way.follow (start, step.share).felt.energy;
        return step;
    }
    if (start.frictionless) return step;
    const SurfaceSample pulled = step.after;
    auto s = slipped (body, tool, pulled, start.foot, unit);
    if (! s) return step;
    step.slips = true;
    const double deeper = jumped ? 0.0 : pulled.felt.d.z() - (tool.radius - start.foot.distance);
    const auto slip = [&] {
        stretch (step.after, *s, deeper);
        step.after.felt = body.stretched (pulled.felt, pulled.touch.foot, step.after.touch.anchor, tool);
    };
    slip();
    const double kept = pulled.felt.d.head<2>().norm();
    if (step.after.felt.energy > pulled.felt.energy && kept > 0.0)
    {
        s = pulled.felt.d.head<2>() * std::min (1.0, s->norm() / kept);   // a law that yields on the way back may leave more than there is
        step.after.touch.anchor = pulled.touch.anchor;
        slip();
    }
    if (jumped)
        step.lost += std::max (0.0, pulled.felt.energy - step.after.felt.energy);
    else
        way.lose (step, start, pulled);
    return step;
}

std::optional<SurfaceEntry> entryOf (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Foot& start, double share, const Vec3& from,
                                     const Vec3& to, bool frictionless) noexcept
{
    constexpr int most = 30;   // steps
    const Vec3 way = to - from;
    Foot foot = start;
    for (int k = 0; k < most; ++k)
    {
        const Vec3 p = from + share * way;
        foot = body.smooth().followed (foot, p);
        if (! foot.found || foot.left || foot.beyond >= 0) return {};
        const double depth = tool.radius - foot.distance, fall = -foot.normal.dot (way);   // the depth grows by this along the whole way
        const bool at_start = share == 0.0 && depth <= 0.0, there = std::abs (depth) <= margin (1e-11) * (1.0 + p.norm());
        if (there && fall > 0.0)
            return SurfaceEntry { { .foot = foot, .anchor = PlacedSurface::placeOf (foot, tool), .frictionless = frictionless }, p };
        if (! (fall > 0.0) && (at_start || depth > 0.0)) return {};
        const double next = fall > 0.0 ? share - depth / fall : 1.0;
        if ((share == 0.0 && next < 0.0) || (share == 1.0 && next > 1.0)) return {};
        share = std::clamp (next, 0.0, 1.0);
    }
    return {};
}

SurfaceSample begun (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Foot& near, bool frictionless, const Vec3& p) noexcept
{
    const Foot foot = body.smooth().followed (near, p);
    if (! foot.found || foot.left || foot.beyond >= 0) return {};
    const SurfaceSample there = sampled (body, tool, { .foot = foot, .anchor = p, .frictionless = frictionless });
    return there.felt.d.z() > 0.0 ? there : SurfaceSample {};
}

}   // namespace tactus
