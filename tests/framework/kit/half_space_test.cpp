// SPDX-License-Identifier: MIT
#include <tactus/kit/geometry/half_space.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <numbers>

using namespace tactus;

namespace
{
/// Depth and force of a tool whose profile has this slope at a radius, with a circle of contact of radius a: the integrals of
/// Sneddon 1965, for r = a sin (t).
std::pair<double, double> sneddon (double modulus, double a, const std::function<double (double)>& slope)
{
    constexpr int n = 2000;
    double depth = 0.0, force = 0.0;
    for (int i = 0; i < n; ++i)
    {
        const double h = 0.5 * std::numbers::pi / n, t = (i + 0.5) * h, s = std::sin (t);
        depth += h * a * slope (a * s);
        force += h * 2.0 * modulus * a * a * s * s * slope (a * s);
    }
    return { depth, force };
}
}   // namespace

TEST_CASE ("half-space: sphere and cone follow from Sneddon's integrals over their profiles", "[kit]")
{
    const HalfSpace body { .young = 12e3, .poisson = 0.45 };
    const double modulus = 12e3 / (1.0 - 0.2025), R = 0.006, angle = 1.1;
    for (const double a : { 1e-4, 1e-3, 2.5e-3 })
    {
        const auto [d, f] = sneddon (modulus, a, [&] (double r) { return r / R; });
        CHECK (body.sphere (R) (d) == Approx (f).epsilon (1e-6));
        const auto [depth, force] = sneddon (modulus, a, [&] (double) { return 1.0 / std::tan (angle); });
        CHECK (body.cone (angle) (depth) == Approx (force).epsilon (1e-6));
    }
}

TEST_CASE ("half-space: worked numbers", "[kit]")
{
    const HalfSpace tissue { .young = 10e3, .poisson = 0.5 };
    CHECK (tissue.modulus() == Approx (13333.333));
    CHECK (tissue.sphere (0.005) (0.002) == Approx (0.1124365).epsilon (1e-5));                  // 4/3 13333.3 0.0707107 8.94427e-5
    CHECK (tissue.punch (0.002) (0.001) == Approx (0.0533333).epsilon (1e-5));                   // 2 0.002 13333.3 0.001
    CHECK (tissue.cone (std::numbers::pi / 4.0) (0.002) == Approx (0.0339531).epsilon (1e-5));   // 2/pi 13333.3 4e-6

    const HalfSpace steel { .young = 210e9, .poisson = 0.3 };
    CHECK (steel.modulus() == Approx (230.769e9).epsilon (1e-5));
    CHECK (steel.sphere (0.01).inverse (100.0) == Approx (2.19415e-6).epsilon (1e-3));   // (9 F^2 / (16 R E*^2))^(1/3)
}

TEST_CASE ("half-space: a punch is pressed in by the mean of its stiffness, whichever way the depth is reached", "[kit]")
{
    // The incremental stiffness of every contact without friction is 2 a E* (Johnson 1985, section 3.6).
    const HalfSpace body { .young = 5e4, .poisson = 0.3 };
    const double R = 0.01, d = 0.001, a = std::sqrt (R * d), h = 1e-7;
    const double slope = (body.sphere (R) (d + h) - body.sphere (R) (d - h)) / (2.0 * h);
    CHECK (slope == Approx (body.punch (a) (1.0)).epsilon (1e-6));
}

TEST_CASE ("half-space: a sphere slides when it has moved sideways as far as Cattaneo and Mindlin say", "[kit]")
{
    const double E = 2e4, nu = 0.4, mu = 0.6, R = 0.005, d = 0.0007;
    const HalfSpace body { .young = E, .poisson = nu };
    const double G = E / (2.0 * (1.0 + nu)), a = std::sqrt (R * d), P = body.sphere (R) (d);
    const double sideways = 3.0 * mu * P * (2.0 - nu) / (16.0 * a * G);   // Johnson 1985, eq. (7.41) at Q = mu P, one body rigid
    CHECK (sideways / d == Approx (body.ratio (mu)).epsilon (1e-9));
    CHECK (HalfSpace { .poisson = 0.5 }.ratio (0.4) == Approx (0.6));
}

TEST_CASE ("half-space: the sideways curve gives the same ratio of drag to push at every depth", "[kit]")
{
    const double mu = 0.3, ratio = 0.45;
    const Law laws[] { { .kind = Law::Kind::power, .a = 1257.0, .b = 1.5 },
                       { .kind = Law::Kind::exponential, .a = 0.2, .b = 400.0 },
                       { .kind = Law::Kind::table, .table = { { 1e-3, 3e-3 }, { 0.1, 0.7 } } } };
    for (const auto& along : laws)
        for (const double d : { 1e-4, 1e-3, 4e-3 })
            CHECK (acrossOf (along, mu, ratio) (ratio * d) == Approx (mu * along (d)).epsilon (1e-12));
}
