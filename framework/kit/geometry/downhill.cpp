// SPDX-License-Identifier: MIT
#include "downhill.hpp"

#include <algorithm>
#include <cmath>

namespace tactus
{

using ContactSample = PlacedSurface::ContactSample;

bool Downhill::along (const Vec3& step, Spot& spot, ContactSample& felt, Reach reach) const noexcept
{
    constexpr double least = 1.0 / 1024.0;   // the smallest share of a step that is tried
    const Spot from = spot;
    const Vec3 inward = felt.frame.row (2).transpose();   // keeps the contact point on its side of a thin body
    const double before = felt.energy;
    double energy = before;   // at the share that was tried last
    const auto lower = [&] (double share, double than) {
        const Spot there = body.walk().nearestFacing (from.triangle, from.on.point + share * step, inward);
        const ContactSample now = body.feel (there, p, tool);
        energy = now.energy;
        if (! (energy <= than)) return false;
        spot = there;
        felt = now;
        return true;
    };

    if (reach == Reach::whole && lower (1.0, before)) return true;
    if (! lower (least, before)) return false;
    const double fall = before - energy;
    double share = reach == Reach::whole ? 0.5 : 1.0;
    while (share > least && ! lower (share, felt.energy))
        share *= 0.5;
    if (share <= least) return true;

    // The energy is lowest at a share that has not been tried. It is estimated by the parabola through the energies at the start, at
    // the smallest share and at the share tried last.
    const double slope = -fall / least, bend = ((energy - before) / share - slope) / (share - least);
    const double lowest = 0.5 * (least - slope / bend);
    if (bend > 0.0 && lowest > least && lowest < 1.0) lower (lowest, felt.energy);
    return true;
}

/// The triangle that the contact point is on, and the energies around this point.
class Downhill::Patch
{
public:
    Patch (const Downhill& d, int index) noexcept
        : downhill (d), triangle (index), corners (cornersOf (d.body.walk().mesh(), index)), gradients (gradientsOf (corners)),
          size (std::sqrt (areaNormal (corners).norm()))
    {
        x = direction (corners[1] - corners[0]);
        y = direction (areaNormal (corners)).cross (x);
    }

    /// The point at an offset in the plane of the triangle, which may be slightly outside the triangle.
    Spot moved (const Spot& from, const Vec3& offset) const noexcept
    {
        Spot there { triangle, {} };
        there.on.point.setZero();
        for (std::size_t i = 0; i < 3; ++i)
        {
            there.on.weights[i] = from.on.weights[i] + gradients[i].dot (offset);
            there.on.point += there.on.weights[i] * corners[i];
        }
        return there;
    }

    /// Puts a spot on the edge opposite a corner.
    void putOnEdge (Spot& spot, int corner) const noexcept
    {
        auto& weights = spot.on.weights;
        weights[at (corner)] = 0.0;
        const double sum = weights[0] + weights[1] + weights[2];
        spot.on.point.setZero();
        for (std::size_t i = 0; i < 3; ++i)
        {
            weights[i] /= sum;
            spot.on.point += weights[i] * corners[i];
        }
    }

    ContactSample feel (const Spot& there) const noexcept { return downhill.body.feel (there, downhill.p, downhill.tool); }
    double energyAt (const Spot& from, const Vec3& offset) const noexcept { return feel (moved (from, offset)).energy; }

    /// The step to the minimum of U, with U approximated by a parabola. If the point is on an edge, the step does not leave the triangle
    /// across this edge.
    Vec3 wanted (const Spot& from, double energy) const noexcept
    {
        const double h = reach();
        const double east = energyAt (from, h * x), west = energyAt (from, -h * x), north = energyAt (from, h * y), south = energyAt (from, -h * y);
        const double gx = (east - west) / (2.0 * h), gy = (north - south) / (2.0 * h);
        const double xx = (east - 2.0 * energy + west) / (h * h), yy = (north - 2.0 * energy + south) / (h * h);
        const double xy = (energyAt (from, h * (x + y)) - east - north + energy) / (h * h), det = xx * yy - xy * xy;
        const Vec3 steepest = -gx * x - gy * y;
        const Vec3 free = det > 0.0 && xx > 0.0 ? Vec3 { ((xy * gy - yy * gx) * x + (xy * gx - xx * gy) * y) / det } : far (steepest);
        if (! leaves (from, free)) return free;

        Vec3 best = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i)   // along an edge
        {
            if (from.on.weights[i] > 0.0) continue;
            Vec3 edge = direction (corners[(i + 2) % 3] - corners[(i + 1) % 3]);
            const double slope = steepest.dot (edge), ex = edge.dot (x), ey = edge.dot (y), bend = xx * ex * ex + 2.0 * xy * ex * ey + yy * ey * ey;
            const Vec3 step = bend > 0.0 ? Vec3 { slope / bend * edge } : far (slope * edge);
            if (! leaves (from, step) && steepest.dot (step) > steepest.dot (best)) best = step;
        }
        return best;
    }

    /// The share of a step, at most 1, at which the step reaches an edge of the triangle, and the number of this edge; -1: no edge.
    std::pair<double, int> room (const Spot& from, const Vec3& step) const noexcept
    {
        std::pair<double, int> found { 1.0, -1 };
        for (int i = 0; i < 3; ++i)
        {
            const double fall = -gradients[at (i)].dot (step);
            if (fall * found.first > from.on.weights[at (i)] && from.on.weights[at (i)] > 0.0) found = { from.on.weights[at (i)] / fall, i };
        }
        return found;
    }

    bool isShort (const Vec3& step) const noexcept { return ! (step.norm() > margin (1e-10) * size); }

private:
    double reach() const noexcept { return 1e-5 * size; }   // step of the finite differences, in m
    Vec3 far (const Vec3& way) const noexcept { return size * direction (way); }

    bool leaves (const Spot& from, const Vec3& step) const noexcept
    {
        for (std::size_t i = 0; i < 3; ++i)
            if (from.on.weights[i] <= 0.0 && gradients[i].dot (step) * size < -margin (1e-9) * step.norm()) return true;
        return false;
    }

    const Downhill& downhill;
    int triangle;
    Corners corners;
    std::array<Vec3, 3> gradients;
    double size;   // m
    Vec3 x, y;     // directions in the plane of the triangle
};

/// Newton's method within the triangle of the spot. Reduces `left`, in m, by the distance that the contact point moves.
void Downhill::descend (Spot& spot, ContactSample& felt, double& left) const noexcept
{
    constexpr int most = 12, halvings = 6;
    const Patch patch (*this, spot.triangle);
    for (int k = 0; k < most; ++k)
    {
        Vec3 step = patch.wanted (spot, felt.energy);
        auto [share, edge] = patch.room (spot, step);
        step *= share;
        if (const double length = step.norm(); length > left)
        {
            step *= std::max (0.0, left) / length;
            edge = -1;
        }
        if (edge < 0 && patch.isShort (step)) return;

        bool fell = false;
        for (int tried = 0; tried < halvings && ! fell; ++tried)
        {
            Spot there = patch.moved (spot, step);
            for (int i = 0; i < 3; ++i)   // puts a point that reaches or stays on an edge exactly on it
            {
                const bool stays = spot.on.weights[at (i)] <= 0.0 && std::abs (there.on.weights[at (i)]) < margin (1e-12);
                if (i == edge || stays) patch.putOnEdge (there, i);
            }
            const ContactSample now = patch.feel (there);
            fell = edge < 0 ? now.energy < felt.energy : now.energy <= felt.energy;   // a step to a very near edge counts even at equal energy
            if (fell)
            {
                left -= (there.on.point - spot.on.point).norm();
                spot = there;
                felt = now;
            }
            step *= 0.5;
            edge = -1;
        }
        if (! fell) return;
    }
}

void Downhill::settle (Spot& spot, ContactSample& felt, double longest) const noexcept
{
    constexpr int most = 16;                   // triangles in one tick
    constexpr double lower = margin (1e-13);   // relative: smaller differences are rounding
    constexpr double on_it = margin (1e-9);    // relative to the size of the coordinates
    double left = longest;
    for (int k = 0; k < most; ++k)
    {
        descend (spot, felt, left);
        const auto& weights = spot.on.weights;
        if (weights[0] > 0.0 && weights[1] > 0.0 && weights[2] > 0.0) return;

        Spot best = spot;
        ContactSample least = felt;
        double rest = left;
        body.walk().around (spot, [&] (int triangle) {
            if (triangle == spot.triangle) return;
            Spot there = body.walk().spotOn (triangle, spot.on.point);
            if (! ((there.on.point - spot.on.point).norm() <= on_it * (spot.on.point.norm() + (p - spot.on.point).norm()))) return;
            ContactSample now = body.feel (there, p, tool);
            double beyond = left;
            descend (there, now, beyond);
            if (! (now.energy < least.energy * (1.0 - lower))) return;
            best = there;
            least = now;
            rest = beyond;
        });
        if (best.triangle == spot.triangle) return;
        spot = best;
        felt = least;
        left = rest;
    }
}

}   // namespace tactus
