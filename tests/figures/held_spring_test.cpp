// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_data.hpp"

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("figure: a spring held between samples gives back half of K dp^2 more at each sample", "[figures]")
{
    const auto run = test::renderFigure ("held_spring", "held_spring", { "--duration", "0.021", "--record", "spring.position.z,spring.resistance" });
    const auto z = run["spring.position.z"], f = run["spring.resistance"];
    REQUIRE (z.size() == 21);
    CHECK (z.front() == Approx (z.back()).margin (1e-15));   // closed

    double given = 0.0, leak = 0.0;   // by the held force, and what theory says of it
    for (std::size_t k = 0; k + 1 < z.size(); ++k)
    {
        const double dp = z[k + 1] - z[k];
        given += f[k] * dp;
        leak += 0.5 * 1000.0 * dp * dp;
    }
    CHECK (given == Approx (leak).epsilon (1e-9));
    CHECK (given > 1e-4);
}
