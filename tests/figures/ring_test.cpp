// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

TEST_CASE ("figure: a second tap adds its ring exactly to what is left of the first", "[figures]")
{
    const auto run = test::renderFigure ("ring", "ring", { "--duration", "0.08", "--record", "rubber.value,wood.value,aluminium.value,first.hit,second.hit" });
    const auto hitOf = [&] (const std::string& trigger) {
        std::size_t k = 0;
        while (k < run.rows() && run.at (trigger + ".hit", k) == 0.0)
            ++k;
        REQUIRE (k < run.rows());
        return std::pair { run.at ("t", k), run.at (trigger + ".hit", k) };
    };

    const struct
    {
        const char* name;
        double frequency, decay, amplitude;   // Hz, 1/s, N s/m, as in the graph
    } materials[] { { "rubber", 18.0, 60.0, 5.8 }, { "wood", 100.0, 80.0, 7.5 }, { "aluminium", 300.0, 90.0, 15.0 } };

    const auto hits = { hitOf ("first"), hitOf ("second") };
    for (const auto& m : materials)
        for (std::size_t k = 0; k < run.rows(); ++k)
        {
            double expected = 0.0;
            for (const auto& [hit, v] : hits)
                if (const double t = run.at ("t", k) - hit; t > 0.0)
                    expected += m.amplitude * v * std::exp (-m.decay * t) * std::sin (2.0 * std::numbers::pi * m.frequency * t);
            CHECK (run.at (std::string (m.name) + ".value", k) == Approx (expected).margin (1e-11));
        }
}
