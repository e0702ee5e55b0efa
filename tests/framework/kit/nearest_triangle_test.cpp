// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/geometry/nearest_triangle.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
/// Coordinates up to 4, often equal, so that corners and points coincide or line up.
Vec3 anyPoint()
{
    Vec3 p;
    for (auto& c : p)
        c = *rc::gen::inRange (-4, 5) * (*rc::gen::inRange (0, 2) == 0 ? 1.0 : 1e-3 * *rc::gen::inRange (1, 1000));
    return p;
}

double distance (const OnTriangle& on, const Vec3& p) { return (on.point - p).norm(); }

OnTriangle checkWeights (const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
    const auto on = nearestOn (a, b, c, p);
    const auto& w = on.weights;
    for (const double one : w)
        RC_ASSERT ((one >= 0.0 && one <= 1.0));
    RC_ASSERT (std::abs (w[0] + w[1] + w[2] - 1.0) < 1e-15);
    RC_ASSERT ((w[0] * a + w[1] * b + w[2] * c - on.point).norm() < 1e-14);
    return on;
}
}   // namespace

TEST_CASE ("the weights of the nearest point are valid, and no other point is nearer", "[nearest]")
{
    // A point of a convex body is nearest to p if and only if no other point of the body lies in front of it, as seen from p.
    // For a triangle it is enough to check the corners.
    test::property ("any triangle, even one without area", [] {
        const Vec3 a = anyPoint(), b = anyPoint(), c = anyPoint(), p = anyPoint();
        const auto on = checkWeights (a, b, c, p);
        for (const auto& corner : { a, b, c })
            RC_ASSERT ((p - on.point).dot (corner - on.point) < 1e-10);
    });

    test::property ("slivers", [] {
        const Vec3 a = anyPoint(), b = anyPoint(), p = anyPoint();
        const double t = *rc::gen::inRange (-3, 14) * 0.1, thin = std::pow (10.0, -*rc::gen::inRange (1, 17));
        const Vec3 c = a + t * (b - a) + thin * anyPoint();
        const double least = distance (checkWeights (a, b, c, p), p);
        for (const auto& edge : { nearestOn (a, b, b, p), nearestOn (b, c, c, p), nearestOn (c, a, a, p) })
            RC_ASSERT (least < distance (edge, p) + 1e-9);
    });
}

TEST_CASE ("a point above a triangle, next to it, and beyond its corner", "[nearest]")
{
    const Vec3 a (0, 0, 0), b (1, 0, 0), c (0, 1, 0);
    CHECK (nearestOn (a, b, c, { 0.25, 0.25, 3.0 }).point == Vec3 (0.25, 0.25, 0.0));
    CHECK (nearestOn (a, b, c, { 0.5, -2.0, 1.0 }).point == Vec3 (0.5, 0.0, 0.0));
    CHECK (nearestOn (a, b, c, { 5.0, -1.0, 0.0 }).point == b);
    CHECK (nearestOn (a, b, c, { 2.0, 2.0, 0.0 }).point == Vec3 (0.5, 0.5, 0.0));
    CHECK (nearestOn (a, a, a, { 2.0, 2.0, 0.0 }).point == a);
}

TEST_CASE ("the nearest of all triangles is found, and if there are several, the first one", "[nearest]")
{
    test::property ("any mesh", [] {
        Mesh mesh;
        for (int i = *rc::gen::inRange (1, 9); i > 0; --i)
            for (int corner = 0; corner < 3; ++corner)
                mesh.points.push_back (anyPoint());
        for (int i = 0; i < static_cast<int> (mesh.points.size()); i += 3)
            mesh.triangles.push_back ({ i, i + 1, i + 2 });

        const Vec3 p = anyPoint();
        const int found = nearestOfAll (mesh, p);
        const auto distance = [&] (int t) { return (nearestOn (mesh, t, p).point - p).squaredNorm(); };
        for (int t = 0; t < static_cast<int> (mesh.triangles.size()); ++t)
            RC_ASSERT ((t < found ? distance (t) > distance (found) : distance (t) >= distance (found)));
    });
}
