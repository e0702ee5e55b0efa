// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;

TEST_CASE ("figure: stick, press harder, let go: 50 strokes give 0.16 mJ if the stiffness follows the load", "[figures]")
{
    constexpr double mu = 0.4, d_max = 1e-5, pull = 8e-6, soft = 0.5, hard = 3.0;   // -, m, m, N, N: as in the graph
    constexpr std::size_t stroke = 400;                                             // ticks
    const auto run = test::renderFigure ("load_strokes", "load_strokes",
                                         { "--duration", "50.0025", "--record",
                                           "hand.out.x,load.out,scale.force.x,passive.force.x,bound.force.x,"
                                           "scale.dissipated_energy,passive.dissipated_energy,bound.dissipated_energy" });
    const auto x = run["hand.out.x"], load = run["load.out"];
    REQUIRE (x.size() == 50 * stroke + 1);
    CHECK (*std::ranges::max_element (x) == Approx (pull));
    CHECK (*std::ranges::max_element (load) == Approx (hard));
    CHECK (*std::ranges::min_element (load) == Approx (soft));

    const double gain = 0.5 * mu * (hard - soft) / d_max * pull * pull;   // J for each stroke
    CHECK (gain == Approx (3.2e-6));
    const auto given = [&] (const std::string& rule, std::size_t strokes) {   // J, by the force on the hand, between samples as on a dense path
        const auto f = run[rule + ".force.x"];
        double work = 0.0;
        for (std::size_t k = 0; k < strokes * stroke; ++k)
            work += 0.5 * (f[k] + f[k + 1]) * (x[k + 1] - x[k]);
        return work;
    };
    for (const std::size_t strokes : { 1u, 7u, 50u })
    {
        CHECK (given ("scale", strokes) == Approx (static_cast<double> (strokes) * gain).epsilon (1e-6));
        CHECK (run.at ("scale.dissipated_energy", strokes * stroke) == Approx (-static_cast<double> (strokes) * gain).epsilon (1e-6));
        CHECK (given ("passive", strokes) < 0.0);
        CHECK (std::abs (given ("bound", strokes)) < 1e-15);
    }
    CHECK (given ("scale", 50) == Approx (0.16e-3));
    CHECK (given ("passive", 50) == Approx (-run.at ("passive.dissipated_energy", 50 * stroke)).epsilon (0.03));
}
