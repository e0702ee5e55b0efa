// SPDX-License-Identifier: MIT
#include "surface_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tactus
{

using ContactSample = PlacedSurface::ContactSample;

namespace
{
using Mat2 = Eigen::Matrix2d;
using Vec2 = Eigen::Vector2d;

// The step of the central differences, in barycentric coordinates: about the cube root of the rounding, also in single precision.
constexpr double h = std::numeric_limits<double>::digits > 24 ? 2e-6 : 5e-3;

/// A spot with coordinate 1 or 2 changed, and coordinate 0 by the opposite amount. It may be slightly outside of its triangle.
Spot beside (const PlacedSurface& body, const Spot& spot, std::size_t k, double change) noexcept
{
    const auto corners = cornersOf (body.walk().mesh(), spot.triangle);
    Spot there = spot;
    there.on.weights[k] += change;
    there.on.weights[0] -= change;
    there.on.point += change * (corners[k] - corners[0]);
    return there;
}

void placeAt (const PlacedSurface& body, Spot& spot) noexcept
{
    const auto corners = cornersOf (body.walk().mesh(), spot.triangle);
    spot.on.point = spot.on.weights[0] * corners[0] + spot.on.weights[1] * corners[1] + spot.on.weights[2] * corners[2];
}

Vec2 offAt (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& spot, const Vec3& p) noexcept
{
    return (body.frameAt (spot, tool) * (p - body.placeOf (spot))).head<2>();
}

struct Found
{
    std::optional<Spot> foot {};
    bool left = false;
};

/// Newton's method, from triangle to triangle. There is no foot beyond the radius of curvature.
Found footOf (const PlacedSurface& body, const PlacedSurface::Tool& tool, Spot spot, const Vec3& p) noexcept
{
    constexpr int most = 200;   // steps
    constexpr double short_step = margin (1e-12);
    int crossed = 0;   // edges since the last step of some length
    for (int i = 0; i < most; ++i)
    {
        const Mat3 frame = body.frameAt (spot, tool);
        const auto corners = cornersOf (body.walk().mesh(), spot.triangle);
        Mat2 slopes, level;
        for (std::size_t k = 1; k < 3; ++k)
        {
            slopes.col (static_cast<int> (k) - 1) =
                (offAt (body, tool, beside (body, spot, k, h), p) - offAt (body, tool, beside (body, spot, k, -h), p)) / (2.0 * h);
            level.col (static_cast<int> (k) - 1) = -(frame * (corners[k] - corners[0])).head<2>();
        }
        const Mat2 ahead = level.inverse() * slopes;   // how far the tool moves per move of the foot
        if (! (ahead.determinant() > 0.0 && ahead.trace() > 0.0)) return {};
        const Vec2 change = -(slopes.inverse() * (frame * (p - body.placeOf (spot))).head<2>());
        const std::array<double, 3> steps { -change.x() - change.y(), change.x(), change.y() };
        if (std::abs (steps[0]) + std::abs (steps[1]) + std::abs (steps[2]) <= short_step) return { .foot = spot };

        double share = 1.0;
        int edge = -1;
        for (int k = 0; k < 3; ++k)
            if (const double weight = spot.on.weights[at (k)]; weight + share * steps[at (k)] < 0.0)
            {
                share = std::max (0.0, weight / -steps[at (k)]);
                edge = k;
            }
        for (std::size_t k = 0; k < 3; ++k)
            spot.on.weights[k] = std::max (0.0, spot.on.weights[k] + share * steps[k]);
        crossed = share > short_step ? 0 : crossed + 1;
        if (edge >= 0)
        {
            spot.on.weights[at (edge)] = 0.0;
            const bool at_rim = body.walk().beside (spot.triangle, edge) < 0;
            if (at_rim && share <= short_step) return { .left = true };
            if (crossed > 20) return {};   // more than the triangles around a corner: both sides of an edge point across it
            if (! at_rim) spot = body.walk().across (spot, edge);
        }
        placeAt (body, spot);
    }
    return {};
}

const Vec3* anchorOf (const SurfaceTouch& touch) noexcept { return touch.frictionless ? nullptr : &touch.anchor; }

/// Puts the anchor where the stretch from the foot is s, along u^x and u^y. Its height falls in the same ratio, so that a short slip changes
/// little: an anchor that has stuck on a curved body is above or below the plane of the foot.
void stretch (SurfaceSample& sample, const Vec2& s) noexcept
{
    const Vec3 before = sample.felt.frame * (sample.felt.place - sample.touch.anchor);
    const double length = before.head<2>().norm(), height = length > 0.0 ? before.z() * std::min (1.0, s.norm() / length) : 0.0;
    sample.touch.anchor = sample.felt.place - sample.felt.frame.transpose() * Vec3 (s.x(), s.y(), height);
}

SurfaceSample sampled (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceTouch& touch, const Vec3& p) noexcept
{
    return { touch, body.feel (touch.foot, p, anchorOf (touch), tool) };
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
std::optional<Vec2> slipped (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceSample& now, const Spot& before,
                             const Bristle& unit) noexcept
{
    const Vec2 pulled = now.felt.d.head<2>();
    const double bound = std::max (0.0, body.ratio (now.touch.foot, now.felt.d.z(), tool) * now.felt.d.z());
    if (! (bound > 0.0)) return pulled.isZero (0.0) ? std::nullopt : std::optional<Vec2> (Vec2::Zero());
    const Bristle bristle = scaled (unit, bound);
    const Vec2 earlier = (now.felt.frame * (body.placeOf (before) - now.touch.anchor)).head<2>();
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
        const Vec3 dc = step.after.touch.anchor - start.anchor, dr = pulled.felt.place - body.placeOf (start.foot);
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
    constexpr double farthest = 8.0;   // the largest move of a foot, relative to that of its tool, that is not a jump
    if (to == from) return sampled (body, tool, touch, to);
    const auto [foot, left] = footOf (body, tool, touch.foot, to);
    SurfaceTouch there = touch;
    there.held = ! foot || touch.held || (foot->on.point - touch.foot.on.point).norm() > farthest * (to - from).norm();
    if (! there.held) there.foot = *foot;
    SurfaceSample sample = sampled (body, tool, there, to);
    sample.left = left;
    return sample;
}

Vec3 forceOf (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceSample& sample, const Vec3& p) noexcept
{
    const auto& [touch, felt, left] = sample;
    const Vec3 along = -felt.f.z() * felt.rise;
    if (touch.held) return along;
    Mat2 slopes;
    Vec2 energy;
    for (std::size_t k = 1; k < 3; ++k)
    {
        const auto more = body.feel (beside (body, touch.foot, k, h), p, anchorOf (touch), tool);
        const auto less = body.feel (beside (body, touch.foot, k, -h), p, anchorOf (touch), tool);
        slopes.col (static_cast<int> (k) - 1) = (more.off - less.off) / (2.0 * h);
        energy[static_cast<int> (k) - 1] = (more.energy - less.energy) / (2.0 * h);
    }
    return along + felt.frame.topRows<2>().transpose() * (slopes.transpose().inverse() * energy);
}

SurfaceStep stepped (const PlacedSurface& body, const PlacedSurface::Tool& tool, const SurfaceTouch& start, const Bristle& unit, const Vec3& from,
                     const Vec3& to) noexcept
{
    const Way way (body, tool, from, to);
    SurfaceStep step { .after = way.follow (start, 1.0), .slips = start.frictionless };
    if (to == from) return step;
    if (step.after.left)   // over the rim
    {
        step.share = 0.0;
        step.lost = sampled (body, tool, start, from).felt.energy;
        step.ends = true;
        return step;
    }
    if (step.after.touch.held)
        if (const auto foot = footOf (body, tool, start.foot, to).foot)   // far away; the stretch is carried along
        {
            const Vec3 d = step.after.felt.d;
            const Vec3 anchor = body.placeOf (*foot) - body.frameAt (*foot, tool).transpose() * Vec3 (d.x(), d.y(), 0.0);
            SurfaceSample there = sampled (body, tool, { .foot = *foot, .anchor = anchor, .frictionless = start.frictionless }, to);
            if (! (there.felt.d.z() > 0.0)) there.felt.energy = 0.0;
            if (there.felt.energy <= step.after.felt.energy)
            {
                step.lost = step.after.felt.energy - there.felt.energy;
                step.after = there;
            }
        }
    const bool jumped = step.lost > 0.0 || step.after.touch.held;
    if (! (step.after.felt.d.z() > 0.0))
    {
        step.ends = true;
        if (step.lost > 0.0) return step;
        const double before = sampled (body, tool, start, from).felt.d.z();
        step.share = before > 0.0 ? before / (before - step.after.felt.d.z()) : 0.0;
        step.lost = way.follow (start, step.share).felt.energy;
        return step;
    }
    if (start.frictionless) return step;
    const SurfaceSample pulled = step.after;
    auto s = slipped (body, tool, pulled, start.foot, unit);
    if (! s) return step;
    step.slips = true;
    const auto slip = [&] {
        stretch (step.after, *s);
        step.after.felt = sampled (body, tool, step.after.touch, to).felt;
    };
    slip();
    const double kept = pulled.felt.d.head<2>().norm();
    if (step.after.felt.energy > pulled.felt.energy && kept > 0.0)
    {
        s = pulled.felt.d.head<2>() * std::min (1.0, s->norm() / kept);   // a law that yields on the way back may leave more than there is
        slip();
    }
    if (jumped)
        step.lost += std::max (0.0, pulled.felt.energy - step.after.felt.energy);
    else
        way.lose (step, start, pulled);
    return step;
}

SurfaceTouch touched (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& entered, bool frictionless) noexcept
{
    const Spot foot = footOf (body, tool, entered, entered.on.point).foot.value_or (entered);
    return { .foot = foot, .anchor = body.placeOf (foot), .frictionless = frictionless };
}

SurfaceSample begun (const PlacedSurface& body, const PlacedSurface::Tool& tool, const Spot& near, bool frictionless, const Vec3& p) noexcept
{
    const auto foot = footOf (body, tool, near, p).foot;
    if (! foot) return {};
    const SurfaceSample there = sampled (body, tool, { .foot = *foot, .anchor = body.placeOf (*foot), .frictionless = frictionless }, p);
    return there.felt.d.z() > 0.0 ? there : SurfaceSample {};
}

}   // namespace tactus
