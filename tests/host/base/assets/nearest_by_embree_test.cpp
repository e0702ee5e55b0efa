// SPDX-License-Identifier: MIT
#include <host/base/assets/nearest_by_embree.hpp>

#include "support/no_allocation.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <limits>
#include <random>

using namespace tactus;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A bumpy patch of n by n squares, 10 cm wide, like the meshes of presets.
Mesh bumpyPatch (int n)
{
    Mesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            mesh.points.emplace_back (0.1 * i / n, 0.1 * j / n, 0.003 * std::sin (0.7 * i) * std::cos (0.4 * j));
    const auto at = [n] (int i, int j) { return i * (n + 1) + j; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
            mesh.triangles.push_back ({ at (i, j), at (i + 1, j), at (i + 1, j + 1) });
            mesh.triangles.push_back ({ at (i, j), at (i + 1, j + 1), at (i, j + 1) });
        }
    return mesh;
}

std::shared_ptr<const Mesh> shared (Mesh mesh) { return std::make_shared<const Mesh> (std::move (mesh)); }
}   // namespace

TEST_CASE ("Embree finds exactly the triangle that a search through all of them finds", "[host][assets][nearest]")
{
    test::property ("any mesh, of any size and at any place, from near and far", [] {
        std::mt19937 dice (*rc::gen::arbitrary<unsigned>());
        std::normal_distribution<double> normal;
        const double size = std::pow (10.0, *rc::gen::inRange (-9, 10)), off = std::pow (10.0, *rc::gen::inRange (-3, 7));
        const auto any = [&] (double s) { return Vec3 (s * normal (dice), s * normal (dice), s * normal (dice)); };

        Mesh mesh;
        const Vec3 place = any (size * off);
        const int points = *rc::gen::inRange (3, 60);
        for (int i = 0; i < points; ++i)
            mesh.points.push_back (place + any (size));
        for (int i = *rc::gen::inRange (1, 200); i > 0; --i)
            mesh.triangles.push_back ({ static_cast<int> (dice() % static_cast<unsigned> (points)), static_cast<int> (dice() % static_cast<unsigned> (points)),
                                        static_cast<int> (dice() % static_cast<unsigned> (points)) });

        const auto all = shared (std::move (mesh));
        const auto nearest = host::nearestByEmbree (all);
        for (int i = 0; i < 20; ++i)
        {
            const Vec3 p = place + any (size * std::pow (10.0, i % 10 - 4));
            RC_ASSERT ((*nearest) (p) == nearestOfAll (*all, p));
        }
        for (const auto& corner : all->points)
            RC_ASSERT ((*nearest) (corner) == nearestOfAll (*all, corner));
    });
}

TEST_CASE ("Embree finds the right triangle among a hundred thousand, without allocating", "[host][assets][nearest]")
{
    const auto mesh = shared (bumpyPatch (224));
    REQUIRE (mesh->triangles.size() > 100'000);
    const auto nearest = host::nearestByEmbree (mesh), again = host::nearestByEmbree (mesh);

    std::mt19937 dice (1);
    std::uniform_real_distribution<double> along (-0.02, 0.12), above (-0.01, 0.02);
    for (int i = 0; i < 20; ++i)
    {
        const Vec3 p (along (dice), along (dice), above (dice));
        int found = 0, allocations = 0, locks = 0;
        {
            const NoAllocation watch;
            found = (*nearest) (p);
            allocations = watch.allocations();
            locks = watch.locks();
        }
        CHECK (found == nearestOfAll (*mesh, p));
        CHECK (found == (*again) (p));
        CHECK (allocations == 0);
        CHECK (locks == 0);
    }
}

TEST_CASE ("Embree gives an answer even for a point that is not finite", "[host][assets][nearest]")
{
    const auto mesh = shared (bumpyPatch (4));
    const auto nearest = host::nearestByEmbree (mesh);
    for (const Vec3& p : { Vec3 (not_a_number, 0, 0), Vec3 (0, 1e300, 0), Vec3 (0, 0, -std::numeric_limits<double>::infinity()) })
    {
        const int found = (*nearest) (p);
        CHECK (found >= 0);
        CHECK (found < static_cast<int> (mesh->triangles.size()));
    }
}
