// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("figure: a spring held between samples gives back K dp^2 / 2 too much at each sample", "[figures]")
{
    constexpr double K = 1000.0;       // N/m, as in the graph
    constexpr std::size_t hold = 20;   // ticks
    const auto run = test::renderFigure ("held_spring", "held_spring", { "--duration", "0.02005", "--record", "press.out,spring.resistance" });
    const auto depth = run["press.out"], f = run["spring.resistance"];
    REQUIRE (depth.size() == 20 * hold + 1);
    CHECK (depth.front() == Approx (depth.back()).margin (1e-15));   // the path is closed

    double given = 0.0, leak = 0.0;   // energy in J: given by the held force, and predicted by theory
    for (std::size_t k = 0; k + 1 < depth.size(); ++k)
    {
        CHECK (f[k] == f[k - k % hold]);
        given -= f[k] * (depth[k + 1] - depth[k]);
        if (k % hold != 0) continue;
        const double dp = depth[k + hold] - depth[k];
        leak += 0.5 * K * dp * dp;
    }
    CHECK (given == Approx (leak).epsilon (1e-9));
    CHECK (given > 1e-4);
}
