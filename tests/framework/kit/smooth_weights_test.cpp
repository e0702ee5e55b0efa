// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/geometry/placed_surface.hpp>

#include <catch2/catch.hpp>

#include <numeric>
#include <random>

using namespace tactus;

namespace
{
using Values = std::array<double, 3>;

/// The value that smooth weights interpolate at p, in a triangle in the xy plane, from the values at its corners.
double interpolated (const Corners& corners, const Values& values, const Vec3& p)
{
    const auto gradients = gradientsOf (corners);
    Values n {}, feet {};
    for (std::size_t i = 0; i < 3; ++i)
    {
        n[i] = gradients[i].dot (p - corners[(i + 1) % 3]);
        const Vec3 edge = corners[(i + 2) % 3] - corners[(i + 1) % 3];
        feet[i] = edge.dot ((corners[0] + corners[1] + corners[2]) / 3.0 - corners[(i + 1) % 3]) / edge.squaredNorm();
    }
    const auto w = smoothWeights (n, feet);
    return std::inner_product (w.begin(), w.end(), values.begin(), 0.0);
}

Vec3 slope (const Corners& corners, const Values& values, const Vec3& p)
{
    constexpr double h = 1e-6;
    const auto at = [&] (const Vec3& q) { return interpolated (corners, values, q); };
    const auto along = [&] (const Vec3& axis) { return (at (p + h * axis) - at (p - h * axis)) / (2.0 * h); };
    return { along (Vec3::UnitX()), along (Vec3::UnitY()), 0.0 };
}
}   // namespace

TEST_CASE ("smooth weights: neither the value nor its gradient steps across an edge, and the weights add up to 1", "[kit]")
{
    test::property ("two triangles that share an edge", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const Vec3 a (-1.0, 0.1 * one (dice), 0.0), b (1.0, 0.1 * one (dice), 0.0);
        const Vec3 above (0.8 * one (dice), 1.0 + 0.5 * one (dice), 0.0), below (0.8 * one (dice), -1.0 + 0.5 * one (dice), 0.0);
        const Values up { one (dice), one (dice), one (dice) }, down { up[1], up[0], one (dice) };
        const double share = 0.5 + 0.45 * one (dice);
        const Vec3 p = a + share * (b - a);
        RC_ASSERT (std::abs (interpolated ({ a, b, above }, up, p) - interpolated ({ b, a, below }, down, p)) < 1e-12);
        RC_ASSERT ((slope ({ a, b, above }, up, p) - slope ({ b, a, below }, down, p)).norm() < 1e-5);

        const Values n { 0.5 * std::abs (one (dice)), 0.5 * std::abs (one (dice)), 0.0 };
        const auto w = smoothWeights ({ n[0], n[1], 1.0 - n[0] - n[1] }, { 0.5, 0.4, 0.6 });
        RC_ASSERT (std::abs (w[0] + w[1] + w[2] - 1.0) < 1e-12);
        RC_ASSERT (std::min ({ w[0], w[1], w[2] }) >= -1e-12);
    });
}

TEST_CASE ("smooth weights: at a corner, the value is that of the corner, and along an edge it follows 3 t^2 - 2 t^3", "[kit]")
{
    constexpr Values feet { 0.5, 0.3, 0.6 };
    CHECK (smoothWeights ({ 1.0, 0.0, 0.0 }, feet)[0] == 1.0);
    CHECK (smoothWeights ({ 0.0, 0.0, 1.0 }, feet)[2] == 1.0);
    for (const double t : { 0.2, 0.5, 0.9 })
        CHECK (smoothWeights ({ 1.0 - t, t, 0.0 }, feet)[1] == Approx (3.0 * t * t - 2.0 * t * t * t));
}
