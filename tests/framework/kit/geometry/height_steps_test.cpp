// SPDX-License-Identifier: MIT
#include <tactus/kit/geometry/height_steps.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace tactus;

namespace
{
/// A ramp, with a hill or without, in this many levels from 0 to 1.
Grid slopeIn (int levels, double hill = 0.0)
{
    Grid grid { .rows = 20, .columns = 1000, .values = {} };
    for (int r = 0; r < grid.rows; ++r)
        for (int c = 0; c < grid.columns; ++c)
        {
            const double h = (1.0 - hill) * c / (grid.columns - 1) + hill * std::sin (0.01 * c) * std::sin (0.1 * r);
            grid.values.push_back (std::round (h * (levels - 1)) / (levels - 1));
        }
    return grid;
}
}   // namespace

TEST_CASE ("height map: the steps of 8 bits are found in slopes, and not where they are not felt", "[height_map]")
{
    CHECK (feltStep (slopeIn (256)) == Approx (1.0 / 255.0));
    CHECK (feltStep (slopeIn (64)) == Approx (1.0 / 63.0));
    CHECK (feltStep (slopeIn (256, 0.3)) == Approx (1.0 / 255.0));
    CHECK (feltStep (slopeIn (65536)) == 0.0);
    Grid noise { .rows = 100, .columns = 100, .values = {} };   // neighbours differ by many steps
    std::mt19937 random (1);
    for (int i = 0; i < 10'000; ++i)
        noise.values.push_back (std::uniform_int_distribution { 0, 255 }(random) / 255.0);
    CHECK (feltStep (noise) == 0.0);
    CHECK (feltStep ({ .rows = 1, .columns = 100, .values = std::vector<double> (100, 0.5) }) == 0.0);
}

TEST_CASE ("height map: smoothing keeps a slope and takes its steps", "[height_map]")
{
    const auto grid = slopeIn (256);
    const MirroredGrid map { { grid.columns - 1, 1e-4 }, { grid.rows - 1, 1e-4 }, grid.values };
    const auto smooth = smoothedOver (map, 1e-3);
    double steepest = 0.0, flattest = 1.0;
    for (int c = 100; c < 900; ++c)
    {
        const double rise = (smooth (5, c + 1) - smooth (5, c)) * (grid.columns - 1);   // 1 on the ramp
        steepest = std::max (steepest, rise);
        flattest = std::min (flattest, rise);
    }
    CHECK (steepest < 1.1);
    CHECK (flattest > 0.9);
    CHECK (smooth (5, 500) == Approx (map (5, 500)).margin (0.5 / 255.0));
}
