// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include "support/no_allocation.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace tactus;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

/// n by n squares of two triangles, 10 cm wide, bumpy or flat.
std::shared_ptr<const Mesh> field (int n, double bumps)
{
    Mesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            mesh.points.emplace_back (0.1 * i / n, 0.1 * j / n, bumps * std::sin (0.7 * i) * std::cos (0.4 * j));
    const auto at = [n] (int i, int j) { return i * (n + 1) + j; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
            mesh.triangles.push_back ({ at (i, j), at (i + 1, j), at (i + 1, j + 1) });
            mesh.triangles.push_back ({ at (i, j), at (i + 1, j + 1), at (i, j + 1) });
        }
    return std::make_shared<const Mesh> (std::move (mesh));
}
}   // namespace

TEST_CASE ("a tree of boxes finds exactly the triangle that a search through all of them finds", "[kit][nearest]")
{
    test::property ("any mesh, of any size and at any place, from near and far", [] {
        std::mt19937 dice (*rc::gen::arbitrary<unsigned>());
        std::normal_distribution<double> normal;
        const double size = std::pow (10.0, *rc::gen::inRange (-9, 10)), off = std::pow (10.0, *rc::gen::inRange (-3, 9));
        const auto any = [&] (double s) { return Vec3 (s * normal (dice), s * normal (dice), s * normal (dice)); };

        Mesh mesh;
        const Vec3 place = any (size * off);
        const auto points = *rc::gen::inRange<unsigned> (3, 60);
        for (unsigned i = 0; i < points; ++i)
            mesh.points.push_back (place + any (size));
        const auto corner = [&] { return static_cast<int> (dice() % points); };
        for (int i = *rc::gen::inRange (1, 300); i > 0; --i)
            mesh.triangles.push_back ({ corner(), corner(), corner() });

        const auto all = std::make_shared<const Mesh> (std::move (mesh));
        const auto nearest = nearestByBoxes (all);
        for (int i = 0; i < 20; ++i)
        {
            const Vec3 p = place + any (size * std::pow (10.0, i % 10 - 4));
            RC_ASSERT ((*nearest) (p) == nearestOfAll (*all, p));
        }
        for (const auto& p : all->points)   // many triangles are equally near
            RC_ASSERT ((*nearest) (p) == nearestOfAll (*all, p));
    });
}

TEST_CASE ("a tree of boxes finds the right one of a hundred thousand triangles, without allocating", "[kit][nearest]")
{
    for (const double bumps : { 0.003, 0.0 })
    {
        const auto mesh = field (224, bumps);
        REQUIRE (mesh->triangles.size() > 100'000);
        const auto nearest = nearestByBoxes (mesh);
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
            CHECK (allocations == 0);
            CHECK (locks == 0);
        }
    }
}

TEST_CASE ("a tree of boxes gives an answer even for a point that is not finite", "[kit][nearest]")
{
    const auto mesh = field (8, 0.003);
    const auto nearest = nearestByBoxes (mesh);
    for (const Vec3& p : { Vec3 (not_a_number, 0, 0), Vec3 (0, 1e300, 0), Vec3 (0, 0, -infinite), Vec3 (infinite, not_a_number, 1) })
        CHECK ((*nearest) (p) == nearestOfAll (*mesh, p));
}
