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

/// A body with a smooth surface through the nodes of a mesh. Never changes once built; all lengths in m.
///
/// Each node i has a polynomial of degree 4, a height over its tangent plane, fitted to the nodes around. d_i (x) is the height of x over it.
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
    struct Foot
    {
        std::array<int, most> triangles { -1, -1, -1 };   ///< a triangle near the foot, of each face that holds it
        int faces = 0;                                    ///< how many faces hold it; 0: none
        Vec3 point = Vec3::Zero();
        Vec3 normal = Vec3::Zero();   ///< out of the body
        double distance = 0.0;        ///< of the tool from the surface, negative inside
        bool found = false;           ///< false if there is no foot near the last one
    };

    /// A foot to begin with, on the corner of a triangle.
    Foot cornerOf (int triangle) const noexcept;

    /// The foot of a tool at p, by Newton's method from the last foot. [any thread]
    Foot followed (const Foot&, const Vec3& p) const noexcept;

    /// The derivative of a foot on a single face in the position of its tool. Symmetric; its pole is the centre of curvature. [any thread]
    Mat3 moves (const Foot&, const Vec3& p) const noexcept;

    /// A node with its share in the mix at a point, and the gradient of the share. Shares are not negative and have a sum of 1.
    struct Share
    {
        int node = 0;   ///< point of the mesh
        double amount = 0.0;
        Vec3 slope = Vec3::Zero();
    };

    /// Calls `use (share)` for each node with a share at x on the face of a triangle. [any thread]
    template <typename Use>
    void mix (int triangle, const Vec3& x, const Use& use) const noexcept;

    int size() const noexcept { return static_cast<int> (corners.size()); }   ///< number of triangles

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
    struct Lists
    {
        std::vector<int> first { 0 }, items {};
    };

    struct Weight
    {
        double w = 0.0, first = 0.0, second = 0.0;   // w; w' / r and (w' / r)' / r of the distance r in m
    };
    static Weight weightOf (const Node&, double r2) noexcept;   // r2: squared distance over radius, below 1

    int walked (int triangle, const Vec3& x) const noexcept;
    bool solve (Foot&, std::array<double, most>& pulls, const Vec3& p) const noexcept;
    void fit (const std::vector<std::vector<int>>& ring);
    void pass();

    std::vector<Node> nodes;
    std::vector<std::array<int, 3>> corners, beside;   // by triangle: nodes; the triangle across the edge opposite a corner, -1 at a crease or a rim
    std::vector<int> face;                             // by triangle
    Lists near, over;                                  // by triangle: nodes with a weight there; one triangle of each other face at its corners
};

//==============================================================================
// Implementation below.

inline SmoothBody::Weight SmoothBody::weightOf (const Node& node, double r2) noexcept
{
    const double r = std::sqrt (r2), o = 1.0 - r, oo = o * o;
    return { oo * oo * (4.0 * r + 1.0), -20.0 * oo * o * node.over, r > 1e-12 ? 60.0 * oo / r * node.over * node.over : 0.0 };
}

template <typename Use>
void SmoothBody::mix (int triangle, const Vec3& x, const Use& use) const noexcept
{
    double sum = 0.0;
    Vec3 slope = Vec3::Zero();
    const auto each = [&] (const auto& visit) {
        for (int k = near.first[at (triangle)]; k < near.first[at (triangle) + 1]; ++k)
        {
            const Node& node = nodes[at (near.items[at (k)])];
            const Vec3 d = x - node.p;
            if (const double r2 = d.squaredNorm() * node.over; r2 < 1.0) visit (node, weightOf (node, r2), d);
        }
    };
    each ([&] (const Node&, const Weight& w, const Vec3& d) {
        sum += w.w;
        slope += w.first * d;
    });
    each ([&] (const Node& node, const Weight& w, const Vec3& d) {
        const double amount = w.w / sum;
        use (Share { node.point, amount, (w.first * d - amount * slope) / sum });
    });
}

}   // namespace tactus
