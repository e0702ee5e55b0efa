// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

TEST_CASE ("figure: the frequency of ridges follows the speed of the hand, and that of a ring does not", "[figures]")
{
    constexpr double per_metre = 2000.0, reach = 0.03, swings_hz = 0.8, ring_hz = 600.0;   // as in the graph
    const auto run = test::analyseFigure ("spectrogram", "spectrogram", { "--duration", "3", "--port", "felt.out", "--window", "0.06", "--up-to", "800" });
    const auto& columns = run.columns();
    int seen = 0, rung = 0;
    for (std::size_t row = 0; row < run.rows(); ++row)
    {
        const double t = run.at ("time (s)", row), turn = 2.0 * std::numbers::pi * swings_hz;
        const double ridges = per_metre * std::abs (reach * turn * std::cos (turn * t));
        std::size_t loudest = 1, ring = 1;
        for (std::size_t c = 1; c < columns.size(); ++c)
        {
            const double hz = std::stod (columns[c]);
            if (hz < 500.0 && run.at (columns[c], row) > run.at (columns[loudest], row)) loudest = c;
            if (hz > 500.0 && run.at (columns[c], row) > run.at (columns[ring], row)) ring = c;
        }
        if (ridges > 250.0)   // near the middle of a stroke, where the speed hardly changes within a window
        {
            CHECK (std::stod (columns[loudest]) == Approx (ridges).margin (20.0));
            ++seen;
        }
        if (run.at (columns[ring], row) > 0.03)
        {
            CHECK (std::stod (columns[ring]) == Approx (ring_hz).margin (17.0));
            ++rung;
        }
    }
    CHECK (seen > 30);
    CHECK (rung > 5);
}
