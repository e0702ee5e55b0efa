// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

TEST_CASE ("figure: ridges stay in place while the stroke speeds up, and fade out before they pass too fast", "[figures]")
{
    constexpr double k = 500.0, amplitude = 0.1, f_max = 80.0;   // 1/m, N, Hz, as in the graph
    const auto run = test::renderFigure ("texture", "texture", { "--duration", "1", "--record", "hand.out.x,drag.force.x,felt.out.x,guard.gain,guard.speed" });

    for (std::size_t i = 0; i < run.rows(); ++i)
    {
        const double ridges = run.at ("felt.out.x", i) - run.at ("drag.force.x", i), gain = run.at ("guard.gain", i), f = k * run.at ("guard.speed", i);
        CHECK (ridges == Approx (gain * amplitude * std::sin (2.0 * std::numbers::pi * k * run.at ("hand.out.x", i))).margin (1e-12));
        if (f < 0.5 * f_max) CHECK (gain == 1.0);
        if (f > f_max) CHECK (gain == 0.0);
    }
    CHECK (k * run.at ("guard.speed", run.rows() - 1) > f_max);
}
