// SPDX-License-Identifier: MIT
#pragma once

#include "mesh_walk.hpp"
#include "rotation.hpp"
#include "smooth_body.hpp"
#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace tactus
{

/// A surface at its place in the world, and the forces it responds with: eq. (5), (6), (8) and (9) of the chapter, in the
/// symbols of nodes/deform/surface.hpp. Never changes once built; all lengths in m.
class PlacedSurface
{
public:
    using Foot = SmoothBody::Foot;

    /// `crease` is in rad, see SmoothBody. `radii` are those of the tools, one for each or one for all; none: points. [main thread]
    PlacedSurface (std::shared_ptr<const Surface>, double scale, const Vec3& origin, const Vec3& rotation, double crease, std::vector<double> radii = {});

    /// A shape that a tool is made of, and its share. The sum of the shares of a tool is 1.
    struct Share
    {
        int shape = 0;
        double amount = 0.0;
    };
    struct Tool
    {
        std::vector<Share> shares;   ///< the first `count` are used
        int count = 0;
        double radius = 0.0;   ///< rho, m
    };

    /// The response of the curves to a tool with this foot.
    struct ContactSample
    {
        Mat3 frame = Mat3::Identity();   ///< rows u^x, u^y, u^z
        Vec3 mixed = Vec3::Zero();       ///< u^x before it is put at right angles to u^z
        Vec3 place = Vec3::Zero();       ///< the foot on the body grown by the radius of the tool, m
        double height = 0.0;             ///< of the place above the anchor, along u^z, m
        Vec3 d = Vec3::Zero();           ///< sideways stretch along u^x and u^y, and depth, m
        Vec3 f = Vec3::Zero();           ///< force along these axes, N
        double pressed = 0.0;            ///< stored energy of the springs along the normal, J
        double energy = 0.0;             ///< all stored energy, J
    };

    const MeshWalk& walk() const noexcept { return mesh_walk; }
    const SmoothBody& smooth() const noexcept { return smooth_body; }

    Tool noTool() const { return { .shares = std::vector<Share> (surface->curves.size()) }; }   ///< with room for every shape

    /// Writes the shares of the tool with this number, at a spot, into `tool`, which must come from noTool(). The number goes from 0 to
    /// the number of tools - 1; a fraction blends two tools. [any thread]
    void choose (double number, const Spot&, Tool& tool) const noexcept;

    /// The foot of a tool at p that starts from a spot of the mesh. [any thread]
    Foot footFrom (const Spot& spot, const Vec3& p) const noexcept { return smooth_body.followed (smooth_body.footOn (spot.triangle, spot.on.point), p); }

    static Vec3 placeOf (const Foot& foot, const Tool& tool) noexcept { return foot.point + tool.radius * foot.normal; }

    /// The response that a tool feels with this foot, stretched from an anchor; null: not stretched. [any thread]
    ContactSample feel (const Foot&, const Vec3* anchor, const Tool&) const noexcept;

    /// The response with the same foot and another anchor. [any thread]
    ContactSample stretched (const ContactSample&, const Foot&, const Vec3& anchor, const Tool&) const noexcept;

    /// The force on a tool at p: minus the gradient of the stored energy in p, with the anchor fixed. [any thread]
    Vec3 forceOf (const Foot&, const ContactSample&, const Vec3& p, const Tool&) const noexcept;

    double ratio (const Foot&, double depth, const Tool&) const noexcept;   ///< mu_c: largest sideways stretch of the contact / its depth

private:
    double shareOf (int shape, int tool, const Spot&) const noexcept;
    double radiusOf (int tool) const noexcept { return radii.empty() ? 0.0 : radii[radii.size() == 1 ? 0 : at (tool)]; }
    Vec3 acrossAt (int node, const Tool&) const noexcept;

    /// The different curves of a shape. Nodes often share a set of them, and then each set is evaluated once.
    struct Laws
    {
        std::vector<Surface::Curves> sets;   // empty if there are more than most_sets
        std::vector<int> of_node;            // empty if there are no sets, or one
    };
    static Laws lawsOf (const std::vector<Surface::Curves>& curves);
    const Surface::Curves& curvesAt (int shape, int node) const noexcept
    {
        const auto& its = laws[at (shape)];
        return its.sets.empty() ? surface->curves[at (shape)][at (node)] : its.sets[at (its.of_node[at (node)])];
    }

    static constexpr int most_sets = 8;   // of the shapes of a tool; with more, the curves of each node are evaluated
    int setsOf (const Tool&) const noexcept;

    /// Calls `use (shape, number of its first set, amount)` for each shape of a tool whose nodes differ.
    template <typename Use>
    void eachShape (const Tool&, const Use& use) const noexcept;

    /// The mean at a foot of what `of (curves)` gives for each set of curves. Starts from `zero`.
    template <typename T, typename Of>
    T meanOf (const Foot&, const Tool&, const T& zero, const Of& of) const noexcept;

    std::shared_ptr<const Surface> surface;
    MeshWalk mesh_walk;
    SmoothBody smooth_body;
    std::vector<Vec3> across;   // u^x by node, or by shape, then node
    std::vector<double> radii;
    std::vector<Laws> laws;   // by shape
    bool alike = false;       // all nodes have the same curves
};

//==============================================================================
// Implementation below.

/// Eq. (8).
inline void PlacedSurface::choose (double number, const Spot& spot, Tool& tool) const noexcept
{
    const int shapes = static_cast<int> (surface->curves.size());
    const int most = (surface->weights.empty() ? shapes : static_cast<int> (surface->weights.size())) - 1;
    const double t = std::clamp (number, 0.0, static_cast<double> (most));
    const int lower = static_cast<int> (t), upper = std::min (lower + 1, most);
    const double second = t - lower;

    tool.radius = (1.0 - second) * radiusOf (lower) + (second > 0.0 ? second * radiusOf (upper) : 0.0);
    tool.count = 0;
    for (int shape = 0; shape < shapes; ++shape)
    {
        const double amount = (1.0 - second) * shareOf (shape, lower, spot) + (second > 0.0 ? second * shareOf (shape, upper, spot) : 0.0);
        if (amount > 0.0) tool.shares[at (tool.count++)] = { shape, amount };
    }
}

/// The share of a shape in a tool. Where the shares differ from node to node, they are interpolated.
inline double PlacedSurface::shareOf (int shape, int tool, const Spot& spot) const noexcept
{
    if (surface->weights.empty()) return shape == tool ? 1.0 : 0.0;
    const auto& nodes = surface->weights[at (tool)];
    if (nodes.size() == 1) return nodes[0][at (shape)];
    const auto& corners = mesh_walk.mesh().triangles[at (spot.triangle)];
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += spot.on.weights[i] * nodes[at (corners[i])][at (shape)];
    return sum;
}

/// u^x at a node; that of each shape counts as much as the shape.
inline Vec3 PlacedSurface::acrossAt (int node, const Tool& tool) const noexcept
{
    const auto nodes = mesh_walk.mesh().points.size();
    if (across.size() == nodes) return across[at (node)];
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < tool.count; ++i)
        sum += tool.shares[at (i)].amount * across[at (tool.shares[at (i)].shape) * nodes + at (node)];
    return sum;
}

inline int PlacedSurface::setsOf (const Tool& tool) const noexcept
{
    int count = 0;
    for (int i = 0; i < tool.count; ++i)
    {
        const auto& sets = laws[at (tool.shares[at (i)].shape)].sets;
        count += sets.empty() ? most_sets + 1 : static_cast<int> (sets.size());
    }
    return count;
}

template <typename Use>
void PlacedSurface::eachShape (const Tool& tool, const Use& use) const noexcept
{
    int first = 0;
    for (int i = 0; i < tool.count; ++i)
    {
        const auto& [shape, amount] = tool.shares[at (i)];
        const auto sets = laws[at (shape)].sets.size();
        if (sets == 1) continue;
        use (shape, first, amount);
        first += static_cast<int> (sets);
    }
}

template <typename T, typename Of>
T PlacedSurface::meanOf (const Foot& foot, const Tool& tool, const T& zero, const Of& of) const noexcept
{
    T all = zero;
    for (int i = 0; i < tool.count; ++i)
        if (const auto& [shape, amount] = tool.shares[at (i)]; laws[at (shape)].sets.size() == 1) all += amount * of (laws[at (shape)].sets[0]);
    if (alike) return all;
    if (const int count = setsOf (tool); count <= most_sets)
    {
        using Amounts = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::DontAlign, most_sets, 1>;
        const Amounts amounts = smooth_body.mean (foot, Amounts (Amounts::Zero (count)), [&] (Amounts& sum, int node, double weight) {
            eachShape (tool, [&] (int shape, int first, double amount) { sum[first + laws[at (shape)].of_node[at (node)]] += amount * weight; });
        });
        eachShape (tool, [&] (int shape, int first, double) {
            const auto& sets = laws[at (shape)].sets;
            for (std::size_t k = 0; k < sets.size(); ++k)
                if (const double amount = amounts[first + static_cast<int> (k)]; amount > 0.0) all += amount * of (sets[k]);
        });
        return all;
    }
    all += smooth_body.mean (foot, zero, [&] (T& sum, int node, double weight) {
        eachShape (tool, [&] (int shape, int, double amount) { sum += weight * amount * of (curvesAt (shape, node)); });
    });
    return all;
}

}   // namespace tactus
