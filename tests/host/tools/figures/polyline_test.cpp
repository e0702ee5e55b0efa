// SPDX-License-Identifier: MIT
#include <host/tools/figures/figure/polyline.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace tactus::host;

namespace
{
const PixelMap to_x { 0.0, 1.0, 0.0f, 800.0f };
const PixelMap to_y { -1.0, 1.0, 400.0f, 0.0f };

std::size_t pointsOf (const std::vector<Polyline>& lines)
{
    std::size_t count = 0;
    for (const auto& line : lines)
        count += line.size();
    return count;
}

float highestIn (const std::vector<Polyline>& lines)
{
    float y = std::numeric_limits<float>::infinity();
    for (const auto& line : lines)
        for (const auto& point : line)
            y = std::min (y, point.y);
    return y;
}
}   // namespace

TEST_CASE ("polyline: a million points are reduced to a few per column, and the only peak is kept", "[host][io][plot]")
{
    std::vector<double> x, y;
    for (int k = 0; k < 1'000'000; ++k)
    {
        x.push_back (k / 1e6);
        y.push_back (0.1 * std::sin (k));
    }
    y[654'321] = 1.0;

    const auto lines = linesThrough (x, y, to_x, to_y);
    CHECK (lines.size() == 1);
    CHECK (pointsOf (lines) <= 4 * 801);
    CHECK (highestIn (lines) == to_y (1.0));
}

TEST_CASE ("polyline: every pixel column keeps its first, lowest, highest and last point", "[host][io][plot]")
{
    const auto kept = [] (const std::vector<std::uint16_t>& heights) {
        std::vector<double> x, y;
        for (std::size_t k = 0; k < heights.size(); ++k)
        {
            x.push_back (static_cast<double> (k) / 8000.0);   // ten per column
            y.push_back (heights[k] / 65536.0);
        }
        const auto lines = linesThrough (x, y, to_x, to_y);
        RC_ASSERT (lines.size() == (heights.empty() ? 0u : 1u));
        if (lines.empty())
            return;

        RC_ASSERT (lines[0].front() == (PixelPoint { to_x (x.front()), to_y (y.front()) }));
        RC_ASSERT (lines[0].back() == (PixelPoint { to_x (x.back()), to_y (y.back()) }));
        for (std::size_t k = 0; k < x.size(); ++k)
        {
            const auto column = std::floor (to_x (x[k]));
            const auto isAbove = [&] (PixelPoint point) { return std::floor (point.x) == column && point.y <= to_y (y[k]); };
            const auto isBelow = [&] (PixelPoint point) { return std::floor (point.x) == column && point.y >= to_y (y[k]); };
            RC_ASSERT (std::ranges::any_of (lines[0], isAbove));
            RC_ASSERT (std::ranges::any_of (lines[0], isBelow));
        }
    };
    tactus::test::property ("any heights", kept);
}

TEST_CASE ("polyline: nan and inf are gaps", "[host][io][plot]")
{
    const auto nan = std::nan ("");
    const auto inf = std::numeric_limits<double>::infinity();
    const std::vector<double> x { 0.0, 0.1, 0.2, 0.3, 0.4, nan, 0.6, 0.7 };
    const std::vector<double> y { 0.0, 0.1, nan, 0.3, -inf, 0.5, 0.6, 0.7 };

    const auto lines = linesThrough (x, y, to_x, to_y);
    REQUIRE (lines.size() == 3);
    CHECK (lines[0].size() == 2);
    CHECK (lines[1].size() == 1);
    CHECK (lines[2].size() == 2);
    CHECK (dotsAt (x, y, to_x, to_y).size() == 5);
}

TEST_CASE ("polyline: a loop repeated a thousand times is drawn once", "[host][io][plot]")
{
    std::vector<double> x, y;
    for (int k = 0; k < 1'000'000; ++k)
    {
        const double phase = k % 1000 * 2 * 3.14159265358979 / 1000;
        x.push_back (0.5 + 0.4 * std::cos (phase));
        y.push_back (0.9 * std::sin (phase));
    }

    const auto lines = linesThrough (x, y, to_x, to_y);
    CHECK (pointsOf (lines) < 1100);
    CHECK (highestIn (lines) == Approx (to_y (0.9)));
    CHECK (dotsAt (x, y, to_x, to_y).size() <= 1000);
}
