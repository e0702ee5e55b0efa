// SPDX-License-Identifier: MIT
#include "placed_surface.hpp"

#include <utility>

namespace tactus
{

namespace
{
Mesh placed (const Mesh& mesh, double scale, const Vec3& origin, const Mat3& turn)
{
    Mesh result = mesh;
    for (auto& p : result.points)
        p = origin + turn * (scale * p);
    return result;
}

/// The u^x for this u^z that results from turning x and -z by the shortest rotation, so that neighbours get similar frames.
Vec3 acrossFor (const Vec3& z) { return z.isZero (0.0) ? Vec3::UnitX() : Vec3 { shortestRotation (-Vec3::UnitZ(), z) * Vec3::UnitX() }; }

using Sample = PlacedSurface::ContactSample;

/// Sets the stretch from an anchor.
void pull (Sample& felt, const Vec3& anchor) noexcept
{
    const Vec3 pulled = felt.frame * (felt.place - anchor);
    felt.d.head<2>() = pulled.head<2>();
    felt.height = pulled.z();
}

/// Adds the response of the curves along x and y. Eq. (6), of one node.
void stretch (Sample& felt, const Surface::Curves& curves, double amount) noexcept
{
    for (int axis = 0; axis < 2; ++axis)
    {
        if (felt.d[axis] == 0.0) continue;
        const auto [force, stored] = curves[at (axis)].at (std::abs (felt.d[axis]));
        felt.f[axis] += amount * (felt.d[axis] < 0.0 ? -force : force);
        felt.energy += amount * stored;
    }
}

/// The energy of the springs of one node.
double energyOf (const Surface::Curves& curves, const Vec3& d) noexcept
{
    double energy = curves[2].energy (d.z());
    for (int axis = 0; axis < 2; ++axis)
        if (d[axis] != 0.0) energy += curves[at (axis)].energy (std::abs (d[axis]));
    return energy;
}
}   // namespace

PlacedSurface::PlacedSurface (std::shared_ptr<const Surface> s, double scale, const Vec3& origin, const Vec3& rotation, double crease, std::vector<double> r)
    : surface (std::move (s)), mesh_walk (placed (*surface->mesh, scale, origin, rotationMatrix (rotation))), smooth_body (mesh_walk, crease),
      radii (std::move (r)), alike (std::ranges::all_of (surface->curves, [] (const auto& nodes) { return nodes.size() == 1; }))
{
    across.reserve (std::max (mesh_walk.mesh().points.size(), surface->frames.size()));
    if (surface->frames.empty())
        for (const auto& n : normalsOf (mesh_walk.mesh()))
            across.push_back (acrossFor (-n));
    for (const auto& f : surface->frames)
        across.push_back (rotationMatrix (rotation) * f.row (0).transpose());
}

PlacedSurface::ContactSample PlacedSurface::feel (const Foot& foot, const Vec3* anchor, const Tool& tool) const noexcept
{
    ContactSample felt;
    const Vec3 z = -foot.normal;
    felt.place = placeOf (foot, tool);
    felt.d.z() = tool.radius - foot.distance;
    if (anchor) smooth_body.mix (foot, nullptr, [&] (const SmoothBody::Share& share) { felt.mixed += share.amount * acrossAt (share.node, tool); });
    Vec3 x = direction (felt.mixed - felt.mixed.dot (z) * z);
    if (x.isZero (0.0)) x = z.unitOrthogonal();
    felt.frame << x.transpose(), z.cross (x).transpose(), z.transpose();
    if (anchor) pull (felt, *anchor);
    mixCurves (foot, tool, [&] (const Surface::Curves& curves, double amount) {
        const auto [force, stored] = curves[2].at (felt.d.z());
        felt.f.z() += amount * force;
        felt.pressed += amount * stored;
        stretch (felt, curves, amount);
    });
    felt.energy += felt.pressed;
    return felt;
}

PlacedSurface::ContactSample PlacedSurface::stretched (const ContactSample& before, const Foot& foot, const Vec3& anchor, const Tool& tool) const noexcept
{
    ContactSample felt = before;
    pull (felt, anchor);
    felt.f.head<2>().setZero();
    felt.energy = 0.0;
    mixCurves (foot, tool, [&] (const Surface::Curves& curves, double amount) { stretch (felt, curves, amount); });
    felt.energy += felt.pressed;
    return felt;
}

Vec3 PlacedSurface::forceOf (const Foot& foot, const ContactSample& felt, const Vec3& p, const Tool& tool) const noexcept
{
    Vec3 force = felt.f.z() * foot.normal;
    const bool stretched = ! felt.d.head<2>().isZero (0.0);
    if (alike && ! stretched) return force;
    const auto motion = smooth_body.motionOf (foot, p);
    const Vec3 x = felt.frame.row (0).transpose(), y = felt.frame.row (1).transpose(), z = felt.frame.row (2).transpose();
    const Vec3 sideways = felt.f.x() * x + felt.f.y() * y;
    if (stretched)
    {
        const Mat3 place = motion.foot + tool.radius * motion.normal;
        force -= place * sideways + felt.height * (motion.normal * sideways);   // both are symmetric
    }
    const double twist = felt.f.x() * felt.d.y() - felt.f.y() * felt.d.x(), length = (felt.mixed - felt.mixed.dot (z) * z).norm();
    const bool turns = stretched && length > 0.0;
    if (turns) force -= twist * felt.mixed.dot (z) / length * (motion.normal * y);
    smooth_body.mix (foot, &motion, [&] (const SmoothBody::Share& share) {
        double change = turns ? twist / length * y.dot (acrossAt (share.node, tool)) : 0.0;
        if (! alike)
            for (int i = 0; i < tool.count; ++i)
                if (const auto& curves = surface->curves[at (tool.shares[at (i)].shape)]; curves.size() > 1)
                    change += tool.shares[at (i)].amount * energyOf (curves[at (share.node)], felt.d);
        force -= change * share.slope;
    });
    return force;
}

double PlacedSurface::ratio (const Foot& foot, double depth, const Tool& tool) const noexcept
{
    const auto& mu = surface->mu;
    if (mu.empty()) return 0.0;
    if (mu.size() == 1) return mu[0](depth);
    const auto nodes = mesh_walk.mesh().points.size();
    double sum = 0.0;
    smooth_body.mix (foot, nullptr, [&] (const SmoothBody::Share& share) {
        if (mu.size() == nodes)
            sum += share.amount * mu[at (share.node)](depth);
        else
            for (int i = 0; i < tool.count; ++i)
                sum += share.amount * tool.shares[at (i)].amount * mu[at (tool.shares[at (i)].shape) * nodes + at (share.node)](depth);
    });
    return sum;
}

}   // namespace tactus
