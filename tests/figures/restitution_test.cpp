// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace tactus;

namespace
{
constexpr double mass = 0.05, lambda = 1.0, dt = 1e-5;   // kg, s/m, s, as in the graph

std::vector<std::string> thrownAt (const test::Scratch& scratch, double v)
{
    std::ostringstream device;
    device.precision (17);
    device << R"({ "driver": "sim", "mass": 0.05, "damping": 0, "position": [0, 0, 1e-6], "velocity": [0, 0, )" << -v << "] }";
    return { "--device", "tool=" + scratch.write ("tool.json", device.str()), "--duration", "0.02",
             "--record", "wall.depth,wall.resistance,player.resistance,motion.velocity.z" };
}

/// Solves lambda v_o - ln (1 + lambda v_o) = lambda v_i - ln (1 + lambda v_i) for e = -v_o / v_i by bisection.
double closedForm (double v)
{
    const auto side = [] (double x) { return x - std::log1p (x); };
    const double x = lambda * v;
    double low = 0.0, high = std::min (1.0, 1.0 / x);
    for (int i = 0; i < 60; ++i)
    {
        const double e = 0.5 * (low + high);
        (side (-e * x) < side (x) ? low : high) = e;
    }
    return low;
}
}   // namespace

TEST_CASE ("figure: the restitution of an impact falls with speed as Hunt and Crossley's law predicts", "[figures]")
{
    CHECK (closedForm (0.15) == Approx (0.909016).epsilon (1e-6));
    CHECK (closedForm (1.0) == Approx (0.593624).epsilon (1e-6));
    CHECK (closedForm (5.0) == Approx (0.196980).epsilon (1e-5));

    const test::Scratch scratch;
    test::Columns rows;
    for (const double v : { 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0 })
    {
        const auto run = test::renderOnce ("restitution", thrownAt (scratch, v));
        double impulse = 0.0;
        for (const double N : run["player.resistance"])
            impulse += N * dt;
        const double felt = run.at ("motion.velocity.z", run.rows() - 1) / v, played = impulse / (mass * v) - 1.0;

        INFO (v << " m/s");
        CHECK (felt == Approx (closedForm (v)).epsilon (0.005));
        CHECK (played == Approx (closedForm (v)).epsilon (1e-4));
        rows.push_back ({ v, felt, played });
    }
    test::writeFigure ("restitution", { "v", "felt", "played" }, rows);

    test::Columns curve;
    for (int i = 1; i <= 210; ++i)
        curve.push_back ({ 0.02 * i, closedForm (0.02 * i) });
    test::writeFigure ("restitution_law", { "v", "e" }, curve);

    for (const auto& [name, v] : { std::pair { "slow", 0.5 }, { "middle", 1.0 }, { "fast", 2.0 } })
        test::renderFigure ("restitution", std::string ("restitution_") + name, thrownAt (scratch, v));
}

TEST_CASE ("chapter: with the minus of eq. (10) as printed, and v into the wall, a tool comes back faster than it came", "[figures]")
{
    // m = k = 1 and a first speed of 1, so lambda v is lambda. The closed form has -lambda in place of lambda.
    for (const auto& [lambda_v, e] : { std::pair { 0.1, 1.07147 }, std::pair { 0.3, 1.25157 } })
    {
        constexpr double h = 1e-5;
        double d = 0.0, v = 1.0;
        do
        {
            v -= 0.5 * h * d * (1.0 - lambda_v * v);
            d += h * v;
            v -= 0.5 * h * d * (1.0 - lambda_v * v);
        } while (d > 0.0);
        CHECK (-v == Approx (e).epsilon (1e-3));
    }
}
