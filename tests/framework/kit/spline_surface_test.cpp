// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/geometry/spline_surface.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

namespace
{
MirroredGrid anyGrid()
{
    const MirroredAxis x { *rc::gen::inRange (0, 9), 1e-3 }, y { *rc::gen::inRange (0, 9), 2e-3 };
    MirroredGrid grid { x, y, {} };
    for (int i = 0; i < x.points() * y.points(); ++i)
        grid.values.push_back (1e-2 * *rc::gen::inRange (-100, 101));
    return grid;
}
}   // namespace

TEST_CASE ("mirrored grid: beyond its ends, the points continue in reverse order", "[framework][grid]")
{
    const MirroredAxis axis { 3, 1.0 };
    const int expected[] { 3, 2, 1, 0, 1, 2, 3, 2, 1, 0, 1 };
    for (int i = -3; i <= 7; ++i)
        CHECK (axis.mirrored (i) == expected[i + 3]);
    CHECK (MirroredAxis {}.mirrored (-5) == 0);
}

TEST_CASE ("mirrored grid: a constant remains constant when resampled, and is its own mean", "[framework][grid]")
{
    const MirroredGrid flat { { 4, 1e-3 }, { 6, 1e-3 }, std::vector<double> (35, 0.25) };
    const auto finer = resampled (flat, flat.x.with (8), flat.y.with (12), 500.0, 16.0);
    REQUIRE (finer.values.size() == 9 * 13);
    for (const double v : finer.values)
        CHECK (v == Approx (0.25).epsilon (1e-14));
    CHECK (meanOf (flat) == Approx (0.25).epsilon (1e-14));
}

TEST_CASE ("mirrored grid: a wave below the cutoff remains, and one above it is removed", "[framework][grid]")
{
    const MirroredAxis axis { 400, 1e-3 };
    const auto left = [&] (double frequency)   // in 1/m
    {
        MirroredGrid wave { axis, {}, {} };
        for (int i = 0; i < axis.points(); ++i)
            wave.values.push_back (std::cos (2.0 * std::numbers::pi * frequency * i * axis.spacing));
        const auto out = resampled (wave, axis.with (200), {}, 100.0, 16.0);
        double most = 0.0;
        for (const double v : out.values)
            most = std::max (most, std::abs (v));
        return most;
    };
    CHECK (left (50.0) == Approx (1.0).epsilon (2e-3));
    CHECK (left (150.0) < 2e-3);
}

TEST_CASE ("spline surface: it passes through its points, and its slopes match its heights", "[framework][grid]")
{
    test::property ("any grid", [] {
        const auto grid = anyGrid();
        const SplineSurface surface { grid };
        for (int row = 0; row < grid.y.points(); ++row)
            for (int column = 0; column < grid.x.points(); ++column)
                RC_ASSERT (std::abs (surface (column * grid.x.spacing, row * grid.y.spacing).height - grid (row, column)) < 1e-12);

        const double x = 1e-5 * *rc::gen::inRange (-2000, 2001), y = 1e-5 * *rc::gen::inRange (-2000, 2001), h = 1e-7;
        const auto at = surface (x, y);
        RC_ASSERT (std::abs (at.slope_x - (surface (x + h, y).height - surface (x - h, y).height) / (2 * h)) < 1e-3);
        RC_ASSERT (std::abs (at.slope_y - (surface (x, y + h).height - surface (x, y - h).height) / (2 * h)) < 1e-3);
    });
}

TEST_CASE ("spline surface: no slope changes faster than the largest curvature allows", "[framework][grid]")
{
    test::property ("any grid, along x and along y", [] {
        const SplineSurface surface { anyGrid() };
        const double most = surface.largestCurvature() * (1.0 + 1e-9) + 1e-6, h = 1e-6;
        const double x = 1e-5 * *rc::gen::inRange (-2000, 2001), y = 1e-5 * *rc::gen::inRange (-2000, 2001);
        RC_ASSERT (std::abs (surface (x + h, y).slope_x - surface (x, y).slope_x) <= most * h);
        RC_ASSERT (std::abs (surface (x, y + h).slope_y - surface (x, y).slope_y) <= most * h);
    });
}
