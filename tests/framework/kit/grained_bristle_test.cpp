// SPDX-License-Identifier: MIT
// The bound of friction on a grain: its nearest point, its normal and its support.
#include <tactus/kit/grained_bristle.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using tactus::FrictionBound;
using Vec2 = FrictionBound::Vec2;

namespace
{
/// The point of the bound at a parameter of its two half ellipses, 0 to 2 pi.
Vec2 pointAt (const FrictionBound& bound, double t)
{
    const double x = std::cos (t);
    return { (x < 0.0 ? bound.against : bound.with) * x, bound.side * std::sin (t) };
}
}   // namespace

TEST_CASE ("friction bound: the nearest point is nearer than all others, and the stretch lies along its normal", "[kit][friction]")
{
    tactus::test::property ("any half axes and stretch, near and far", [] (unsigned seed) {
        std::mt19937 random (seed);
        const auto uniform = [&] (double low, double high) { return std::uniform_real_distribution<double> (low, high) (random); };
        const auto axis = [&] { return uniform (0.0, 1.0) < 0.1 ? 1e-30 : std::pow (10.0, uniform (-6.0, -2.0)); };
        const FrictionBound bound { axis(), axis(), axis() };
        const double size = std::max ({ bound.with, bound.against, bound.side });
        const double angle = uniform (0.0, 2.0 * M_PI), far = size * std::pow (10.0, uniform (-6.0, 3.0));
        const Vec2 edge = pointAt (bound, uniform (0.0, 2.0 * M_PI)), d = edge + far * Vec2 (std::cos (angle), std::sin (angle));
        if (! (bound.share (d) > 1.0 + 1e-9)) return;

        const Vec2 n = bound.normalNearest (d), found = bound.withNormal (n), way = d - found;
        RC_ASSERT (std::abs (n.norm() - 1.0) < 1e-12);
        RC_ASSERT (std::abs (n.x() * way.y() - n.y() * way.x()) < 1e-9 * size + 1e-12 * way.norm());
        RC_ASSERT (n.dot (way) > 0.0);
        for (int k = 0; k < 2000; ++k)
        {
            const Vec2 other = pointAt (bound, 2.0 * M_PI * k / 2000.0);
            RC_ASSERT ((d - other).norm() >= way.norm() - 1e-12 * (size + way.norm()));
            RC_ASSERT (other.dot (n) <= bound.support (n) * (1.0 + 1e-12));
        }
    });
}

TEST_CASE ("friction bound: an enlarged bound has its nearest point there", "[kit][friction]")
{
    const FrictionBound bound { 2e-4, 5e-4, 1e-4 }, twice { 4e-4, 10e-4, 2e-4 };
    for (int k = 0; k < 100; ++k)
    {
        const Vec2 d { 2e-3 * std::cos (0.1 * k), 2e-3 * std::sin (0.1 * k) };
        CHECK ((bound.normalNearest (d, 2.0) - twice.normalNearest (d)).norm() < 1e-15);
    }
}
