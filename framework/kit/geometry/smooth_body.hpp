// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/kit/vec3.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace tactus
{

class MeshWalk;

/// A body with a smooth surface through the nodes of a mesh. Never changes once built; all lengths in m.
///
/// Each node i has a polynomial of degree 4, a height over its tangent plane, fitted to the nodes of three rings around. d_i (x) is the height of x
/// over it. A small weight on all terms keeps those small that few nodes determine.
/// The surface is where
///
///     g (x) = sum_i w_i d_i / sum_i w_i = 0,   w_i = (1 - r)^4 (4 r + 1),   r = |x - node i| / (1.6 times its longest edge), 0 for r > 1
///
/// g has two continuous derivatives, so the curvature has no steps. The mesh is cut into faces along its creases. Each face has a g of its own,
/// and near a crease the body is the intersection of its faces.
///
/// The force f (w) n of a tool, w its distance from the surface and n the normal there, changes by at most max (k, f / (R - w)) per distance
/// moved, with the steepest slope k of f and the smallest radius of curvature R: the foot is the nearest point.
///
/// Source: Ohtake, Belyaev, Alexa, Turk & Seidel 2003 (partition of unity); Wendland 1995. Reasons and limits: docs/decisions/smooth_bodies.md.
class SmoothBody
{
public:
    /// Triangles that meet at a larger angle than `crease` (rad) meet at a crease. A crease that does not cut the mesh into faces is smooth. All
    /// indices of the triangles must be valid. [main thread]
    SmoothBody (const MeshWalk&, double crease);
    SmoothBody (const Mesh&, double crease);

    /// g of a face with its gradient and second derivatives. [any thread]
    struct Value
    {
        double g = 0.0;
        Vec3 slope = Vec3::Zero();
        Mat3 bend = Mat3::Zero();
        bool known = false;   ///< false if no node is near
    };
    Value valueAt (int triangle, const Vec3& x) const noexcept;

    static constexpr int most = 3;   ///< faces that hold a foot: 1 on a face, 2 on an edge, 3 at a corner

    /// The nearest point of the surface.
    ///
    /// A tool outside is held by the edges and corners where the body is convex, a tool inside by those where it is hollow. In the other two cases
    /// the nearest point changes over from a face to the next at the crease, so the foot stays on its own face, and `beyond` says which face it
    /// has passed.
    struct Foot
    {
        std::array<int, most> triangles { -1, -1, -1 };   ///< a triangle near the foot, of each face that holds it
        std::array<double, most> pulls {};                ///< p - point is the sum of pull times the gradient of g, over these faces
        int faces = 0;                                    ///< how many faces hold it; 0: none
        Vec3 point = Vec3::Zero();
        Vec3 normal = Vec3::Zero();   ///< out of the body
        double side = 1.0;            ///< 1 if an edge or corner where the body is convex holds it, -1 where it is hollow
        double distance = 0.0;        ///< of the tool from the surface, negative inside
        bool found = false;           ///< false if there is no foot near the last one, or a tool deeper than 0.95 of the radius of curvature
        Value value {};               ///< g at the point, if known: see know()
        bool left = false;            ///< beyond the rim of an open mesh
        int beyond = -1;              ///< a triangle of the face that the foot has passed; -1: none
    };

    /// A foot to begin with, on a triangle.
    Foot footOn (int triangle, const Vec3& point) const noexcept;

    /// The foot of a tool at p, by Newton's method from the last foot. [any thread]
    Foot followed (const Foot&, const Vec3& p) const noexcept;

    /// Computes g at a foot on a face, if it is not known yet. The next search from there and motionOf() then need not. [any thread]
    void know (Foot& foot) const noexcept
    {
        if (foot.faces == 1 && ! foot.value.known) foot.value = valueAt (foot.triangles[0], foot.point);
    }

    /// The derivatives of a foot in the position of its tool. Their pole is the centre of curvature.
    struct Motion
    {
        Mat3 foot = Mat3::Zero(), normal = Mat3::Zero();                             ///< symmetric
        std::array<Vec3, most> parts { Vec3::Zero(), Vec3::Zero(), Vec3::Zero() };   ///< of partsOf()
    };
    Motion motionOf (const Foot&, const Vec3& p) const noexcept;   // [any thread]

    /// The part of each face in what is mixed at a foot: 1 on a face. Around an edge, they change over smoothly with the direction of the tool.
    static std::array<double, most> partsOf (const Foot&) noexcept;

    /// The mean over the points of the mesh near a foot: `add (sum, point, weight)` adds weight times what a point has to a sum that starts as
    /// `zero`. Weights are not negative. A point may come several times. [any thread]
    template <typename T, typename Add>
    T mean (const Foot&, const T& zero, const Add& add) const noexcept;

    /// The gradient of a mean of numbers in the position of the tool. `of (point)` is the number that a point has. [any thread]
    template <typename Of>
    Vec3 meanSlope (const Foot&, const Motion&, const Of& of) const noexcept;

    int size() const noexcept { return static_cast<int> (corners.size()); }   ///< number of triangles
    bool hasCreases() const noexcept { return ! over.items.empty(); }
    double reachAt (int triangle) const noexcept { return nodes[at (corners[at (triangle)][0])].radius; }   ///< of the nodes there, m

private:
    static constexpr int terms = 15;   // 1 x y xx xy yy xxx xxy xyy yyy xxxx xxxy xxyy xyyy yyyy

    /// A node of a face: a point of the mesh that lies on two faces has two.
    struct Node
    {
        int point = 0;
        Vec3 p = Vec3::Zero();
        Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();   // z: out of the body
        double radius = 1.0, over = 1.0;                                // radius^-2
        std::array<double, terms> c {};                                 // height over the tangent plane
    };

    /// A list of lists: list i goes from first[i] to just before first[i + 1].
    template <typename T>
    struct Lists
    {
        std::vector<int> first;
        std::vector<T> items;
    };

    /// A triangle of another face at a crease.
    struct Other
    {
        int triangle = 0;
        double bulges = 1.0;   // 1 if the body is convex there, -1 if it is hollow
    };

    struct Weight
    {
        double w = 0.0, first = 0.0, second = 0.0;   // w; w' / r and (w' / r)' / r of the distance r in m
    };
    static Weight weightOf (const Node&, double r2) noexcept;   // r2: squared distance over radius, below 1

    template <typename Use>
    void eachNear (int triangle, const Vec3& x, const Use& use) const noexcept;
    int walked (int triangle, const Vec3& x) const noexcept;
    std::array<double, 3> weightsOn (int triangle, const Vec3& x) const noexcept;
    bool solve (Foot&, const Vec3& p) const noexcept;
    static bool leave (Foot&, double slack) noexcept;
    bool cross (Foot&, bool inside, double slack) const noexcept;
    void placeNodes (const MeshWalk&);
    void fit (const MeshWalk&);
    void findNear (const MeshWalk&);
    void findOver (const MeshWalk&);
    void pass();
    template <typename Use>
    void neighbours (const MeshWalk&, int node, const Use& use) const;

    std::vector<Node> nodes;
    std::vector<std::array<int, 3>> corners, beside;   // by triangle: nodes; the triangle across the edge opposite a corner, -1 at a crease or a rim
    std::vector<std::array<bool, 3>> rim;              // by triangle: whether the edge opposite a corner belongs to no other triangle
    std::vector<int> face;                             // by triangle
    Lists<int> near;                                   // by triangle: nodes with a weight there
    Lists<Other> over;                                 // by triangle: one triangle of each other face at its corners
};

//==============================================================================
// Implementation below.

inline SmoothBody::Weight SmoothBody::weightOf (const Node& node, double r2) noexcept
{
    const double r = std::sqrt (r2), o = 1.0 - r, oo = o * o;
    return { oo * oo * (4.0 * r + 1.0), -20.0 * oo * o * node.over, r > 1e-12 ? 60.0 * oo / r * node.over * node.over : 0.0 };
}

/// Calls `use (node, r2, d)` for each node with a weight at x, r2 as in weightOf(), d from the node to x.
template <typename Use>
void SmoothBody::eachNear (int triangle, const Vec3& x, const Use& use) const noexcept
{
    for (int k = near.first[at (triangle)]; k < near.first[at (triangle) + 1]; ++k)
    {
        const Node& node = nodes[at (near.items[at (k)])];
        const Vec3 d = x - node.p;
        if (const double r2 = d.squaredNorm() * node.over; r2 < 1.0) use (node, r2, d);
    }
}

template <typename T, typename Add>
T SmoothBody::mean (const Foot& foot, const T& zero, const Add& add) const noexcept
{
    const auto parts = partsOf (foot);
    T all = zero;
    for (int i = 0; i < foot.faces; ++i)
    {
        if (parts[at (i)] == 0.0) continue;
        double weights = 0.0;
        T sum = zero;
        eachNear (foot.triangles[at (i)], foot.point, [&] (const Node& node, double r2, const Vec3&) {
            const double w = weightOf (node, r2).w;
            weights += w;
            add (sum, node.point, w);
        });
        if (weights > 0.0) all += parts[at (i)] / weights * sum;
    }
    return all;
}

template <typename Of>
Vec3 SmoothBody::meanSlope (const Foot& foot, const Motion& motion, const Of& of) const noexcept
{
    const auto parts = partsOf (foot);
    Vec3 all = Vec3::Zero();
    for (int i = 0; i < foot.faces; ++i)
    {
        if (parts[at (i)] == 0.0) continue;   // its slope is 0, too
        double weights = 0.0, sum = 0.0;
        Vec3 slope = Vec3::Zero(), sum_slope = Vec3::Zero();
        eachNear (foot.triangles[at (i)], foot.point, [&] (const Node& node, double r2, const Vec3& d) {
            const Weight w = weightOf (node, r2);
            const double number = of (node.point);
            weights += w.w;
            sum += w.w * number;
            for (int k = 0; k < 3; ++k)   // Eigen's sums are not always inlined here
            {
                slope[k] += w.first * d[k];
                sum_slope[k] += w.first * number * d[k];
            }
        });
        if (! (weights > 0.0)) continue;
        const double mean = sum / weights;
        all += parts[at (i)] / weights * (motion.foot * (sum_slope - mean * slope)) + mean * motion.parts[at (i)];
    }
    return all;
}

}   // namespace tactus
