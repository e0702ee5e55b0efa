// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus;

TEST_CASE ("figure: a contact point stays inside the circle of d_max around the tool, or is pulled straight onto it", "[figures]")
{
    constexpr double d_max = 1e-3;   // m, as in the graph
    const auto run = test::renderFigure ("friction_step", "friction_step", { "--duration", "0.007", "--record", "tool.out,contact.deflection,contact.state" });
    REQUIRE (run.rows() == 7);

    double cx = run.at ("tool.out.x", 0), cy = run.at ("tool.out.y", 0);   // the contact point starts below the tool
    std::vector<double> stretches;
    for (std::size_t k = 0; k < run.rows(); ++k)
    {
        const double x = run.at ("tool.out.x", k), y = run.at ("tool.out.y", k), stretch = std::hypot (x - cx, y - cy);
        stretches.push_back (stretch);
        const bool slips = stretch > d_max;
        if (slips)
        {
            cx = x - (x - cx) * d_max / stretch;
            cy = y - (y - cy) * d_max / stretch;
        }
        INFO ("step " << k);
        CHECK (run.at ("contact.state", k) == (slips ? 2.0 : 1.0));
        CHECK (run.at ("contact.deflection.x", k) == Approx (x - cx).margin (1e-15));
        CHECK (run.at ("contact.deflection.y", k) == Approx (y - cy).margin (1e-15));
    }
    CHECK (stretches[1] == Approx (0.76e-3).margin (0.005e-3));   // as docs/chapter.md says
    CHECK (stretches[2] == Approx (2.10e-3).margin (0.005e-3));
    CHECK (run.at ("contact.state", 6) == 1.0);
}
