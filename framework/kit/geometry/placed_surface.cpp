// SPDX-License-Identifier: MIT
#include "placed_surface.hpp"

#include <array>
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

/// Force along x and y, and the energy of these springs. Eq. (6), of one node.
Vec3 sidewaysOf (const Surface::Curves& curves, const Vec3& d) noexcept
{
    Vec3 response = Vec3::Zero();
    for (int axis = 0; axis < 2; ++axis)
    {
        if (d[axis] == 0.0) continue;
        const auto [force, stored] = curves[at (axis)].at (std::abs (d[axis]));
        response[axis] = d[axis] < 0.0 ? -force : force;
        response.z() += stored;
    }
    return response;
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
      radii (std::move (r))
{
    laws.reserve (surface->curves.size());
    for (const auto& nodes : surface->curves)
        laws.push_back (lawsOf (nodes));
    alike = std::ranges::all_of (laws, [] (const Laws& its) { return its.sets.size() == 1; });
    across.reserve (std::max (mesh_walk.mesh().points.size(), surface->frames.size()));
    if (surface->frames.empty())
        for (const auto& n : normalsOf (mesh_walk.mesh()))
            across.push_back (acrossFor (-n));
    for (const auto& f : surface->frames)
        across.push_back (rotationMatrix (rotation) * f.row (0).transpose());
}

PlacedSurface::Laws PlacedSurface::lawsOf (const std::vector<Surface::Curves>& curves)
{
    Laws laws;
    laws.sets.reserve (std::min (curves.size(), at (most_sets + 1)));
    laws.of_node.reserve (curves.size());
    for (const auto& c : curves)
    {
        const auto same = std::ranges::find (laws.sets, c);
        laws.of_node.push_back (static_cast<int> (same - laws.sets.begin()));
        if (same == laws.sets.end()) laws.sets.push_back (c);
        if (laws.sets.size() > at (most_sets)) return {};   // evaluating each once would take as long
    }
    if (laws.sets.size() == 1) laws.of_node.clear();
    return laws;
}

PlacedSurface::ContactSample PlacedSurface::feel (const Foot& foot, const Vec3* anchor, const Tool& tool) const noexcept
{
    ContactSample felt;
    const Vec3 z = -foot.normal;
    felt.place = placeOf (foot, tool);
    felt.d.z() = tool.radius - foot.distance;
    if (anchor)
        felt.mixed = smooth_body.mean (foot, Vec3 (Vec3::Zero()), [&] (Vec3& sum, int node, double weight) {
            const Vec3 x = acrossAt (node, tool);
            for (int k = 0; k < 3; ++k)
                sum[k] += weight * x[k];
        });
    Vec3 x = direction (felt.mixed - felt.mixed.dot (z) * z);
    if (x.isZero (0.0)) x = z.unitOrthogonal();
    felt.frame << x.transpose(), z.cross (x).transpose(), z.transpose();
    if (anchor) pull (felt, *anchor);
    using Response = Eigen::Matrix<double, 5, 1>;   // f, then the energies of the springs sideways and along the normal
    const Response response = meanOf (foot, tool, Response (Response::Zero()), [&] (const Surface::Curves& curves) {
        const Vec3 sideways = sidewaysOf (curves, felt.d);
        const auto [force, stored] = curves[2].at (felt.d.z());
        Response its;
        its << sideways.x(), sideways.y(), force, sideways.z(), stored;
        return its;
    });
    felt.f = response.head<3>();
    felt.pressed = response[4];
    felt.energy = response[3] + felt.pressed;
    return felt;
}

PlacedSurface::ContactSample PlacedSurface::stretched (const ContactSample& before, const Foot& foot, const Vec3& anchor, const Tool& tool) const noexcept
{
    ContactSample felt = before;
    pull (felt, anchor);
    const Vec3 response =
        meanOf (foot, tool, Vec3 (Vec3::Zero()), [&] (const Surface::Curves& curves) { return sidewaysOf (curves, felt.d); });
    felt.f.head<2>() = response.head<2>();
    felt.energy = response.z() + felt.pressed;
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
    std::array<double, at (most_sets)> energies {};
    const bool few = setsOf (tool) <= most_sets;
    if (few)
        eachShape (tool, [&] (int shape, int first, double) {
            const auto& sets = laws[at (shape)].sets;
            for (std::size_t k = 0; k < sets.size(); ++k)
                energies[at (first) + k] = energyOf (sets[k], felt.d);
        });
    force -= smooth_body.meanSlope (foot, motion, [&] (int node) {
        double number = turns ? twist / length * y.dot (acrossAt (node, tool)) : 0.0;
        eachShape (tool, [&] (int shape, int first, double amount) {
            number += amount * (few ? energies[at (first + laws[at (shape)].of_node[at (node)])] : energyOf (curvesAt (shape, node), felt.d));
        });
        return number;
    });
    return force;
}

double PlacedSurface::ratio (const Foot& foot, double depth, const Tool& tool) const noexcept
{
    const auto& mu = surface->mu;
    if (mu.empty()) return 0.0;
    if (mu.size() == 1) return mu[0](depth);
    const auto nodes = mesh_walk.mesh().points.size();
    return smooth_body.mean (foot, 0.0, [&] (double& sum, int node, double weight) {
        if (mu.size() == nodes)
            sum += weight * mu[at (node)](depth);
        else
            for (int i = 0; i < tool.count; ++i)
                sum += weight * tool.shares[at (i)].amount * mu[at (tool.shares[at (i)].shape) * nodes + at (node)](depth);
    });
}

}   // namespace tactus
