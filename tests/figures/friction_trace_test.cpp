// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;

TEST_CASE ("figure: along a stroke the contact follows on a leash of d_max, and moves only while the leash is taut", "[figures]")
{
    constexpr double d_max = 1e-3;
    const auto run = test::renderFigure ("friction_trace", "friction_trace", { "--duration", "3.75", "--record", "tool.out,contact.deflection,contact.state" });

    std::size_t stuck = 0, slips = 0;
    double furthest = 0.0;
    for (std::size_t k = 1; k < run.rows(); ++k)
    {
        const auto contactAt = [&] (const char* axis, std::size_t row) {
            const double tool = run.at (std::string ("tool.out.") + axis, row);
            return tool - run.at (std::string ("contact.deflection.") + axis, row);
        };
        const double moved = std::hypot (contactAt ("x", k) - contactAt ("x", k - 1), contactAt ("y", k) - contactAt ("y", k - 1));
        const double stretch = std::hypot (run.at ("contact.deflection.x", k), run.at ("contact.deflection.y", k));
        furthest = std::max (furthest, stretch);
        if (run.at ("contact.state", k) == 2.0)
        {
            ++slips;
            CHECK (stretch == Approx (d_max));
        }
        else
        {
            ++stuck;
            CHECK (moved < 1e-15);
        }
    }
    CHECK (furthest <= d_max * (1.0 + 1e-9));
    CHECK (stuck > run.rows() / 10);
    CHECK (slips > run.rows() / 4);

    const auto last = run.rows() - 1;   // the stroke ends stuck, on a stretched leash
    CHECK (run.at ("contact.state", last) == 1.0);
    CHECK (std::hypot (run.at ("contact.deflection.x", last), run.at ("contact.deflection.y", last)) > 0.3 * d_max);
}
