// SPDX-License-Identifier: MIT
#include <host/tools/figures/plot.hpp>
#include <host/tools/figures/spectrogram.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

using namespace tactus::host;

namespace
{
constexpr double sample_rate = 4000.0;

std::vector<double> toneOf (double amplitude, double hz, std::size_t n)
{
    std::vector<double> all (n);
    for (std::size_t i = 0; i < n; ++i)
        all[i] = amplitude * std::sin (2.0 * std::numbers::pi * hz * static_cast<double> (i) / sample_rate);
    return all;
}
}   // namespace

TEST_CASE ("spectrogram: each column shows the frequency that the signal has at its time", "[host][io][spectrum]")
{
    rc::check ("two tones, one after the other", [] {
        const double first = *rc::gen::inRange (50, 950), second = *rc::gen::inRange (50, 950);
        auto signal = toneOf (1.0, first, 4000);
        const auto later = toneOf (0.3, second, 4000);
        signal.insert (signal.end(), later.begin(), later.end());
        const auto s = spectrogramOf ({ signal }, sample_rate, 0.1, 1000.0);
        RC_ASSERT (s.at.size() == s.columns.size());
        RC_ASSERT (s.at.size() > 50u);
        constexpr double bin = 1.0 / 0.1;
        for (std::size_t i = 0; i < s.at.size(); ++i)
        {
            if (std::abs (s.at[i] - 1.0) <= 0.06) continue;   // the window is partly in both
            RC_ASSERT (std::abs (ridgeOf (s, i) - (s.at[i] < 1.0 ? first : second)) <= bin);
            const double loudest = *std::max_element (s.columns[i].begin(), s.columns[i].end());
            RC_ASSERT (std::abs (loudest / (s.at[i] < 1.0 ? 1.0 : 0.3) - 1.0) < 0.05);
        }
    });
}

TEST_CASE ("spectrogram: the strength of a vector does not depend on the directions of the axes", "[host][io][spectrum]")
{
    rc::check ("a vector turned by any angle", [] {
        const double angle = *rc::gen::inRange (0, 628) / 100.0, hz = *rc::gen::inRange (50, 900);
        const auto along = toneOf (2.0, hz, 1000), across = toneOf (0.5, 1.5 * hz, 1000);
        Components turned (2, std::vector<double> (1000));
        for (std::size_t i = 0; i < 1000; ++i)
        {
            turned[0][i] = std::cos (angle) * along[i] - std::sin (angle) * across[i];
            turned[1][i] = std::sin (angle) * along[i] + std::cos (angle) * across[i];
        }
        const auto straight = spectrogramOf ({ along, across }, sample_rate, 0.1, 2000.0), other = spectrogramOf (turned, sample_rate, 0.1, 2000.0);
        RC_ASSERT (straight.columns.size() == other.columns.size());
        for (std::size_t c = 0; c < straight.columns.size(); ++c)
            for (std::size_t i = 0; i < straight.columns[c].size(); ++i)
                RC_ASSERT (std::abs (straight.columns[c][i] - other.columns[c][i]) < 1e-9);
    });
}

TEST_CASE ("spectrogram: columns end at the highest frequency, and a signal shorter than a window gives no columns", "[host][io][spectrum]")
{
    const auto s = spectrogramOf ({ toneOf (1.0, 100.0, 4000) }, sample_rate, 0.1, 500.0);
    REQUIRE_FALSE (s.columns.empty());
    CHECK (static_cast<double> (s.columns.front().size() - 1) * s.step_hz <= 500.0);
    CHECK (static_cast<double> (s.columns.front().size()) * s.step_hz > 500.0);
    CHECK (spectrogramOf ({ toneOf (1.0, 100.0, 4000) }, sample_rate, 0.1, 1e6).columns.front().size() > 400);
    CHECK (spectrogramOf ({ toneOf (1.0, 100.0, 300) }, sample_rate, 0.1, 500.0).columns.empty());
    CHECK (spectrogramOf ({}, sample_rate, 0.1, 500.0).columns.empty());
    CHECK (spectrogramOf ({ toneOf (1.0, 100.0, 400'000) }, sample_rate, 0.1, 500.0, 100).columns.size() <= 101);
}

TEST_CASE ("spectrogram: a map is in decibels relative to one unit, from the loudest line down", "[host][io][spectrum]")
{
    const auto map = heatMapOf (spectrogramOf ({ toneOf (0.1, 200.0, 8000) }, sample_rate, 0.128, 1000.0), "N", 40.0);
    CHECK (map.colour.unit == "dB re 1 N");
    CHECK (map.range.high == Approx (-20.0).margin (0.5));
    CHECK (map.range.size() == Approx (40.0));
    CHECK (map.values.size() == map.columns * map.rows);
    CHECK (map.x.low >= 0.0);
    CHECK (heatMapOf ({}, "N", 40.0).values.empty());
}
