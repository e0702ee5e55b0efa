// SPDX-License-Identifier: MIT
#include <tactus/nodes/texture/grating.hpp>

#include <golden/golden.hpp>
#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using tactus::Vec3;
using tactus::nodes::Grating;
using tactus::test::Golden;
using tactus::test::ready;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
}   // namespace

TEST_CASE ("grating: along a line and across a plane it matches the golden columns", "[nodes][texture][golden]")
{
    const Golden golden ("texture");
    const auto position = [&] (std::size_t i) { return Vec3 { golden (i, "x"), golden (i, "y"), golden (i, "dz") }; };

    auto line = ready<Grating> ({ .amplitude = golden.param ("A"), .spatial_frequency = golden.param ("k"), .phase = golden.param ("phi") });
    CHECK (golden.worst ("grating1d", [&] (std::size_t i) { return line.tick ({ .position = position (i) }).value; })
           <= 1.0);

    const double kx = golden.param ("kx"), ky = golden.param ("ky");
    auto wave = ready<Grating> ({ .amplitude = golden.param ("A"), .spatial_frequency = std::hypot (kx, ky), .angle = std::atan2 (ky, kx) });
    for (const int axis : { 0, 1 })
        CHECK (golden.worst (axis == 0 ? "grating2d_x" : "grating2d_y", [&] (std::size_t i) { return wave.tick ({ .position = position (i) }).force[axis]; })
               <= 1.0);
}

TEST_CASE ("grating: 200 ridges per metre are 5 mm apart", "[nodes][texture]")
{
    auto node = ready<Grating> ({ .amplitude = 0.3, .spatial_frequency = 200.0 });
    CHECK (node.tick ({ .position = { 1.25e-3, 9, 9 } }).value == Approx (0.3));
    CHECK (node.tick ({ .position = { 3.75e-3, 9, 9 } }).value == Approx (-0.3));
    CHECK (node.tick ({ .position = { 1.25e-3 + 5e-3, 9, 9 } }).value == Approx (0.3));
}

TEST_CASE ("grating: no closed path gains or loses energy", "[nodes][texture][energy]")
{
    auto node = ready<Grating> ({ .amplitude = 0.3, .spatial_frequency = 500.0, .angle = 0.9, .phase = 0.4 });
    const int n = 100'000;
    double work = 0.0, moved = 0.0;
    Vec3 p = Vec3::Zero(), f = node.tick ({}).force;
    for (int k = 1; k <= n; ++k)
    {
        const double s = 2.0 * M_PI * k / n;
        const Vec3 next { 0.02 * std::sin (3.0 * s), 0.03 * std::sin (2.0 * s), 0.01 * std::sin (s) };
        const Vec3 force = node.tick ({ .position = next }).force;
        const double step = -0.5 * (f + force).dot (next - p);
        work += step;
        moved += std::abs (step);
        p = next;
        f = force;
    }
    CHECK (moved > 1e-2);
    CHECK (std::abs (work) < 1e-9 * moved);
}

TEST_CASE ("grating: its steepest slope is 2 pi A k, as it claims", "[nodes][texture]")
{
    auto node = ready<Grating> ({ .amplitude = 0.2, .spatial_frequency = 300.0, .angle = -2.0, .phase = 1.0 });
    const auto claims = node.claims();
    CHECK (claims.stiffness == Approx (2.0 * M_PI * 60.0));
    CHECK (claims.passive);
    CHECK (claims.spatial_frequency == 300.0);

    const double step = 1e-7;
    double steepest = 0.0, largest = 0.0, before = node.tick ({}).value;
    for (int k = 1; k < 100'000; ++k)
    {
        const double s = step * k;
        const double value = node.tick ({ .position = { s * std::cos (-2.0), s * std::sin (-2.0), 0 } }).value;
        steepest = std::max (steepest, std::abs (value - before) / step);
        largest = std::max (largest, std::abs (value));
        before = value;
    }
    CHECK (steepest <= claims.stiffness);
    CHECK (steepest == Approx (claims.stiffness).epsilon (1e-4));
    CHECK (largest <= claims.amplitude);
}

TEST_CASE ("grating: no input breaks it", "[nodes][texture]")
{
    tactus::test::property ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -0.02, 1e-320, -1e160, 1e300, -1.7e308, not_a_number, tactus::inf);
        const double amplitude = *rc::gen::element (0.0, 0.3, 1e300), k = *rc::gen::element (0.0, 200.0, 1e300),
                     angle = *rc::gen::element (0.0, 3.0, 1e300);
        auto node = ready<Grating> ({ .amplitude = amplitude, .spatial_frequency = k, .angle = angle });
        const double x = *number, y = *number, z = *number;
        const auto out = node.tick ({ .position = { x, y, z } });
        RC_ASSERT (tactus::isFinite (out.force, out.value));
        if (! tactus::isFinite (Vec3 { x, y, z })) RC_ASSERT (out.force.isZero (0.0));
    });
}
