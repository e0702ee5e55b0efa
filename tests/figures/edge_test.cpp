// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;

namespace
{
constexpr double f_cut = 4.0, width = 0.02, stiffness = 2000.0, rupture = 0.003;   // N, 200 J/m2 times 20 mm; m; N/m; m, the depth at which 6 N bursts it
}

TEST_CASE ("figure: the force of a tilted edge ramps over width times sine of the angle, up to the cost of its surface", "[figures]")
{
    const auto ports = "down.out,level.resistance,tilted.resistance,steep.resistance";
    const auto run = test::renderFigure ("edge", "edge_tilted", { "--duration", "8", "--record", ports });
    for (const auto& [edge, degrees] : { std::pair { "level", 0.0 }, { "tilted", 10.0 }, { "steep", 20.0 } })
    {
        INFO (edge);
        const double angle = degrees * M_PI / 180.0, ramp = width * std::sin (angle);
        int plateau = 0;
        for (std::size_t k = 0; k < run.rows(); ++k)
        {
            const double deepest = 0.5 * ramp - run.at ("down.out", k), f = run.at (std::string (edge) + ".resistance", k);
            if (deepest > ramp + rupture + 1.2e-3)
            {
                ++plateau;
                CHECK (f == Approx (f_cut * std::cos (angle)).epsilon (1e-3));
            }
            // Before the rupture, the edge is inside the sample over a length of deepest / tan (angle), at half of `deepest` on average.
            if (angle > 0.0 && deepest > 0.5e-3 && deepest < 0.99 * rupture)
                CHECK (f == Approx (0.5 * stiffness / width * deepest * deepest / std::tan (angle)).epsilon (0.01));
            if (angle > 0.0 && deepest > 0.0) CHECK (f < 1.01 * f_cut * std::cos (angle));   // no snap
        }
        CHECK (plateau > 500);
    }
}

TEST_CASE ("figure: an edge breaks through its sample once in each place", "[figures]")
{
    const auto run = test::renderFigure ("edge", "edge_moved", { "--duration", "8.5", "--record", "strokes.out,moved.resistance,moved.state" });
    const auto strongest = [&] (double from, double to) {
        double most = 0.0;
        for (std::size_t k = 0; k < run.rows(); ++k)
            if (const double t = run.at ("t", k); t >= from && t < to) most = std::max (most, run.at ("moved.resistance", k));
        return most;
    };
    CHECK (strongest (0.0, 2.0) == Approx (6.0).margin (0.01));
    CHECK (strongest (3.0, 5.0) == Approx (f_cut));   // back in its cut
    CHECK (strongest (6.5, 8.5) == Approx (6.0).margin (0.02));

    int ruptures = 0;
    for (std::size_t k = 0; k < run.rows(); ++k)
        ruptures += run.at ("moved.state", k) == 2.0;
    CHECK (ruptures == 2);
}
