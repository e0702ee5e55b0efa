// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/geometry/mesh_walk.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
/// Coordinates up to 4, often equal, so that distances are often equal too.
Vec3 anyPoint()
{
    Vec3 p;
    for (auto& c : p)
        c = *rc::gen::inRange (-4, 5) * (*rc::gen::inRange (0, 2) == 0 ? 1.0 : 1e-3 * *rc::gen::inRange (1, 1000));
    return p;
}

/// Triangles that share corners, flat or crumpled.
Mesh anySheet()
{
    constexpr int side = 5;
    Mesh mesh;
    const double rough = *rc::gen::element (0.0, 1e-9, 0.3, 3.0);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            mesh.points.push_back (Vec3 (i - 2.0, j - 2.0, 0.0) + rough * anyPoint());
    for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < side; ++i)
        {
            const int a = j * side + i, b = a + 1, c = a + side, d = c + 1;
            mesh.triangles.push_back ({ a, b, d });
            mesh.triangles.push_back ({ a, d, c });
        }
    return mesh;
}

double distance2 (const Spot& spot, const Vec3& p) { return (spot.on.point - p).squaredNorm(); }

bool same (const Spot& a, const Spot& b) { return a.triangle == b.triangle && a.on.weights == b.on.weights && a.on.point == b.on.point; }

/// One step of a walk that skips no triangle.
Spot stepFrom (const MeshWalk& walk, const Spot& here, const Vec3& p)
{
    Spot best = here;
    double least = distance2 (here, p) * (1.0 - 1e-12);
    const auto& mesh = walk.mesh();
    for (std::size_t c = 0; c < 3; ++c)
    {
        if (here.on.weights[c] <= 0.0) continue;
        const int corner = mesh.triangles[static_cast<std::size_t> (here.triangle)][c];
        for (int t = 0; t < static_cast<int> (mesh.triangles.size()); ++t)
        {
            if (std::ranges::count (mesh.triangles[static_cast<std::size_t> (t)], corner) == 0) continue;
            const Spot there = walk.spotOn (t, p);
            if (distance2 (there, p) >= least) continue;
            best = there;
            least = distance2 (there, p);
        }
    }
    return best;
}
}   // namespace

TEST_CASE ("the nearest of all triangles does not depend on the initial guess", "[nearest]")
{
    test::property ("any sheet", [] {
        const MeshWalk walk { anySheet() };
        const Vec3 p = anyPoint() * *rc::gen::element (1e-12, 1.0, 1e6);
        const int guess = *rc::gen::inRange (-1, static_cast<int> (walk.mesh().triangles.size()));
        RC_ASSERT (same (walk.nearestOfAll (p, guess), walk.spotOn (nearestOfAll (walk.mesh(), p), p)));
    });
}

TEST_CASE ("a walk skips no nearer triangle", "[nearest]")
{
    test::property ("any sheet", [] {
        const MeshWalk walk { anySheet() };
        const Vec3 p = anyPoint();
        const int from = *rc::gen::inRange (0, static_cast<int> (walk.mesh().triangles.size()));
        Spot here = walk.spotOn (from, p);
        for (Spot next = stepFrom (walk, here, p); next.triangle != here.triangle; next = stepFrom (walk, here, p))
            here = next;
        RC_ASSERT (same (walk.nearest (from, p), here));
    });
}
