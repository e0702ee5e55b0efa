// SPDX-License-Identifier: GPL-3.0-or-later
#include <support/property.hpp>

#include <host/tools/figures/spectrum.hpp>

#include "made_trace.hpp"

#include <cmath>
#include <numbers>

using namespace tactus::host;

namespace
{
constexpr double rate = 4000.0;

std::vector<double> sine (double amplitude, double hz, double phase, std::size_t n, double offset = 0.0)
{
    std::vector<double> all (n);
    for (std::size_t i = 0; i < n; ++i)
        all[i] = offset + amplitude * std::sin (2.0 * std::numbers::pi * hz * static_cast<double> (i) / rate + phase);
    return all;
}
}   // namespace

TEST_CASE ("scopes: a sine of any amplitude, frequency and phase shows its amplitude at its frequency", "[app][scopes]")
{
    tactus::test::property ("on an offset, in a window of any length", [] {
        const auto n = *rc::gen::inRange<std::size_t> (1000, 6000);
        const double bin = rate / static_cast<double> (n);
        const double hz = bin * (8.0 + *rc::gen::inRange (0, 10000) / 10000.0 * (0.5 * static_cast<double> (n) - 16.0));
        const double amplitude = std::pow (10.0, *rc::gen::inRange (-60, 30) / 10.0);
        const double phase = *rc::gen::inRange (0, 628) / 100.0;
        const auto spectrum = spectrumOf (sine (amplitude, hz, phase, n, 3.0 * amplitude), rate);
        const auto peak = peakOf (spectrum, 1.0);
        RC_ASSERT (peak.has_value());
        RC_ASSERT (std::abs (peak->amplitude - amplitude) < 0.005 * amplitude);
        RC_ASSERT (std::abs (peak->hz - hz) < 0.05 * bin);
        double highest = 0.0;
        for (const double a : spectrum.amplitude)
            highest = std::max (highest, a);
        RC_ASSERT (highest > 0.98 * amplitude);
        RC_ASSERT (highest < 1.005 * amplitude);
    });
}

TEST_CASE ("scopes: a faint sine next to a loud one shows its own amplitude", "[app][scopes]")
{
    auto both = sine (1.0, 100.0, 0.3, 4000);
    const auto faint = sine (0.01, 317.3, 1.1, 4000);
    for (std::size_t i = 0; i < both.size(); ++i)
        both[i] += faint[i];
    const auto peak = peakOf (spectrumOf (both, rate), 200.0);
    REQUIRE (peak);
    CHECK (peak->hz == Approx (317.3).margin (0.1));
    CHECK (peak->amplitude == Approx (0.01).epsilon (0.01));
}

TEST_CASE ("scopes: a constant signal has no peak, and its spectrum reaches half the rate", "[app][scopes]")
{
    const auto flat = spectrumOf (std::vector<double> (1024, 2.5), rate);
    CHECK_FALSE (peakOf (flat, 1.0));
    CHECK (flat.hz (flat.amplitude.size() - 1) == Approx (rate / 2.0));
    CHECK (spectrumOf (std::vector<double> (3, 1.0), rate).amplitude.empty());
}

TEST_CASE ("scopes: in a gap the previous value is held, and the gap is counted", "[app][scopes]")
{
    const auto latest = latestSamples (*traceOf ({ 9.0, 1.0, std::nan (""), std::nan (""), 2.0 }), 0.004);
    CHECK (latest.values == std::vector<double> { 1.0, 1.0, 1.0, 2.0 });
    CHECK (latest.missing == 2);
}
