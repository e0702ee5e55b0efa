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

TEST_CASE ("figure: ridges under a tool shake it as often as they pass, and by their force over its mass", "[figures]")
{
    constexpr double k = 500.0, amplitude = 0.1, mass = 0.1, B = 1.0, rate = 4000.0;   // 1/m, N, kg, N s/m, Hz, as in the graph
    const auto run = test::renderFigure ("texture_surface", "texture_surface",
                                         { "--duration", "1", "--record", "hand.position.x,tip.velocity.x,ridges.out.x,drag.force.x,motor.force.x" });
    const auto x = run["hand.position.x"], v = run["tip.velocity.x"], f = run["motor.force.x"], drag = run["drag.force.x"];
    double shaken = 0.0;   // m2/s4
    int passed = 0, counted = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
    {
        const double a = rate * (v[i + 1] - v[i]);
        CHECK (mass * a == Approx (0.6 + f[i] - 0.5 * B * (v[i] + v[i + 1])).margin (1e-4));   // Newton
        CHECK (f[i] - drag[i] == Approx (amplitude * std::sin (2.0 * std::numbers::pi * k * x[i])).margin (1e-12));
        if (std::floor (k * x[i + 1]) > std::floor (k * x[i])) ++passed;
        if (run.at ("hand.position.x", i) < 0.1) continue;
        shaken += a * a;
        ++counted;
    }
    CHECK (passed == static_cast<int> (k * x.back()));
    CHECK (k * v.back() == Approx (100.0).epsilon (0.01));                                    // Hz
    CHECK (std::sqrt (2.0 * shaken / counted) == Approx (amplitude / mass).epsilon (0.02));   // m/s2: the peak of a sine with this rms
}
