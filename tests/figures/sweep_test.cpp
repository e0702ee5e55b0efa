// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;

TEST_CASE ("figure: against stroke speed, the frequency of ridges is a line through the origin, and that of a resonance is constant", "[figures]")
{
    constexpr double per_metre = 1250.0, length = 0.06, resonance = 300.0;   // as in the graph
    const auto run = test::analyseFigure ("sweep", "sweep", { "--speed", "0.02..0.4", "--steps", "96", "--up-to", "600" });
    REQUIRE (run.rows() == 96);
    const auto& columns = run.columns();
    const auto loudestIn = [&] (std::size_t row, double from_hz, double to_hz) {
        std::size_t loudest = 0;
        for (std::size_t c = 1; c < columns.size(); ++c)
            if (const double hz = std::stod (columns[c]); hz >= from_hz && hz <= to_hz)
                if (loudest == 0 || run.at (columns[c], row) > run.at (columns[loudest], row)) loudest = c;
        return std::stod (columns[loudest]);
    };
    for (std::size_t row = 0; row < run.rows(); ++row)
    {
        const double speed = run.at ("speed (m/s)", row), ridges = per_metre * speed;
        CHECK (loudestIn (row, 1.0, 600.0) == Approx (ridges).margin (speed / length));
        if (ridges < 180.0) CHECK (loudestIn (row, 220.0, 600.0) == Approx (resonance).margin (60.0));
    }
}
