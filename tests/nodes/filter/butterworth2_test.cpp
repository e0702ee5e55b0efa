// SPDX-License-Identifier: MIT
#include "response.hpp"

#include <nodes/filter/butterworth2.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <string>

using tactus::nodes::Butterworth2;

namespace
{
Butterworth2 filterOf (double cutoff, double rate_hz = 1000.0)
{
    Butterworth2 node;
    node.params.cutoff = cutoff;
    node.prepare ({ .rate_hz = rate_hz });
    node.update();
    return node;
}
}   // namespace

TEST_CASE ("butterworth: its response is that of the analogue filter, bilinear", "[nodes][filter]")
{
    rc::prop ("any cutoff and frequency", []
              {
        const double cutoff = *rc::gen::inRange (5, 495) / 1000.0, turns = *rc::gen::inRange (0, 500) / 1000.0;
        const auto s = bilinear (turns, cutoff);
        const auto wanted = 1.0 / (s * s + std::numbers::sqrt2 * s + 1.0);
        RC_ASSERT (std::abs (Response { filterOf (1000.0 * cutoff) }(turns) - wanted) < 1e-9); });
}

TEST_CASE ("butterworth: is 3 dB down at the cutoff, passes rest whole and nothing at half the rate", "[nodes][filter]")
{
    const double cutoff = GENERATE (5.0, 100.0, 250.0, 480.0);
    const Response response { filterOf (cutoff) };
    CHECK (std::norm (response (cutoff / 1000.0)) == Approx (0.5));
    CHECK (std::abs (response (0.0)) == Approx (1.0));
    CHECK (std::abs (response (0.5)) < 1e-9);
}

TEST_CASE ("butterworth: is stable at any cutoff, also beyond half the rate", "[nodes][filter]")
{
    const double cutoff = GENERATE (0.0, 1e-9, 1.0, 499.9, 500.0, 501.0, 1e6, 1e300);
    auto node = filterOf (cutoff);
    double out = 0.0;
    for (int k = 0; k < 100'000; ++k)
    {
        out = node.tick ({ .in = k % 3 == 0 ? 1.0 : -0.5 }).out;
        REQUIRE (std::abs (out) <= 2.0);
    }
    if (cutoff >= 500.0)
        for (int k = 0; k < 30'000; ++k)
            out = node.tick ({ .in = 1.0 }).out;
    if (cutoff >= 500.0) CHECK (out == Approx (1.0));
}

TEST_CASE ("butterworth: starts from rest after a sample that is no number", "[nodes][filter]")
{
    auto used = filterOf (50.0), fresh = filterOf (50.0);
    for (int k = 0; k < 10; ++k)
        used.tick ({ .in = 1.0 });
    CHECK (used.tick ({ .in = std::numeric_limits<double>::quiet_NaN() }).out == 0.0);
    for (int k = 0; k < 10; ++k)
        CHECK (used.tick ({ .in = 2.0 }).out == fresh.tick ({ .in = 2.0 }).out);
}

TEST_CASE ("butterworth: overshoots a step by 4 %", "[nodes][filter]")
{
    auto node = filterOf (10.0, 10'000.0);
    double highest = 0.0;
    for (int k = 0; k < 5000; ++k)
        highest = std::max (highest, node.tick ({ .in = 1.0 }).out);
    CHECK (highest == Approx (1.0 + std::exp (-std::numbers::pi)).epsilon (1e-4));
}

TEST_CASE ("butterworth: rebuilds the golden texture", "[nodes][filter][golden]")
{
    std::ifstream file { TACTUS_SOURCE_DIR "/tests/golden/texture.csv" };
    std::string line, cell;
    REQUIRE (std::getline (file, line));

    int windowed = -1, filtered = -1, column = 0;
    for (std::istringstream header { line }; std::getline (header, cell, ','); ++column)
    {
        if (cell == "windowed") windowed = column;
        if (cell == "filtered") filtered = column;
    }
    REQUIRE (windowed >= 0);
    REQUIRE (filtered >= 0);

    auto node = filterOf (120.0);
    int rows = 0;
    while (std::getline (file, line))
    {
        double in = 0.0, expected = 0.0;
        column = 0;
        for (std::istringstream row { line }; std::getline (row, cell, ','); ++column)
        {
            if (column == windowed) in = std::stod (cell);
            if (column == filtered) expected = std::stod (cell);
        }
        INFO ("row " << rows);
        REQUIRE (node.tick ({ .in = in }).out == Approx (expected).margin (1e-9).epsilon (0));
        ++rows;
    }
    CHECK (rows == 900);
}
