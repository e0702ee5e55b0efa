// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/layers/bands.hpp>
#include <host/app/layers/meter.hpp>
#include <host/app/layers/taper.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

using namespace tactus::host;

namespace
{
std::vector<double> tone (double amplitude, double hz, double rate, std::size_t n)
{
    std::vector<double> x (n);
    for (std::size_t i = 0; i < n; ++i)
        x[i] = amplitude * std::sin (2.0 * std::numbers::pi * hz * static_cast<double> (i) / rate);
    return x;
}
}   // namespace

TEST_CASE ("a tone appears in the band of its frequency, with its mean square", "[layers]")
{
    CHECK (rc::check ([] {
        const double hz = 20.0 * std::pow (40.0, *rc::gen::inRange (0, 1001) * 1e-3), amplitude = *rc::gen::inRange (1, 1000) * 1e-2;
        const auto bands = bandsOf (tone (amplitude, hz, 4000.0, 4096), 4000.0);
        const double all = std::accumulate (bands.power.begin(), bands.power.end(), 0.0);
        RC_ASSERT (std::abs (all - 0.5 * amplitude * amplitude) < 0.02 * all);
        double near = 0.0;   // the power of the bands within 4 Hz, about four spectral lines
        for (int b = 0; b < Bands::count; ++b)
            if (Bands::edge (b + 1) > hz - 4.0 && Bands::edge (b) < hz + 4.0) near += bands.power[static_cast<std::size_t> (b)];
        RC_ASSERT (near > 0.98 * all);
    }));
}

TEST_CASE ("silence, too few samples and missed ticks give no power", "[layers]")
{
    const std::vector<double> silence (256, 0.0), too_few (2, 1.0), missed (256, std::numeric_limits<double>::quiet_NaN());
    for (const auto& samples : { silence, too_few, missed })
        CHECK (bandsOf (samples, 4000.0).power == Bands {}.power);
}

TEST_CASE ("a meter shows the RMS level, and holds the peak until the present one takes its place, however large it was", "[layers]")
{
    for (const double amplitude : { 2.0, 1e61 })
    {
        Meter meter;
        const auto loud = tone (amplitude, 100.0, 4000.0, 400);
        const double peak = *std::ranges::max_element (loud);
        meter.take (loud, loud.size(), 0.1);
        CHECK (meter.rms() == Approx (amplitude * std::sqrt (0.5)));
        CHECK (meter.peak() == peak);
        const std::vector<double> soft (400, 0.25);
        for (int i = 0; i < 40; ++i)
        {
            meter.take (soft, soft.size(), 0.1);
            CHECK (meter.rms() == 0.25);
            CHECK ((meter.peak() == peak || meter.peak() == 0.25));   // never a level between them
            if (i < 19) CHECK (meter.peak() == peak);
            if (i > 20) CHECK (meter.peak() == 0.25);
        }
        const std::vector<double> silence (400, 0.0);
        for (int i = 0; i < 30; ++i)
            meter.take (silence, silence.size(), 0.1);
        CHECK (meter.peak() == 0.0);
    }
}

TEST_CASE ("fader position and gain are inverse, monotonic, and 1 at the unity mark", "[layers]")
{
    CHECK (Taper::gain (0.0) == 0.0);
    CHECK (Taper::gain (Taper::unity) == Approx (1.0));
    CHECK (Taper::gain (1.0) == Taper::most);
    CHECK (rc::check ([] {
        const double p = *rc::gen::inRange (0, 1001) * 1e-3, q = *rc::gen::inRange (0, 1001) * 1e-3;
        RC_ASSERT (std::abs (Taper::position (Taper::gain (p)) - p) < 1e-12);
        RC_ASSERT ((p < q) == (Taper::gain (p) < Taper::gain (q)));
    }));
}
