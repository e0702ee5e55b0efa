// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/random.hpp>
#include <tactus/kit/signal/band_noise.hpp>
#include <tactus/node/generic.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace tactus::nodes
{

/// Gaussian noise within a band of frequencies, the same at any tick rate.
///
///     out = amplitude n (t)
///
/// n is a function of time, not of ticks: its spectrum is flat up to 0.8 `bandwidth` and 60 dB down from `bandwidth` upwards, and
/// its RMS is 1. So all graphs with a rate of at least 2 `bandwidth` get the same noise with the RMS `amplitude`. A slower graph
/// cannot render the whole band: its noise has only the power below half of its rate.
///
/// With a bandwidth of 0 the noise is white: a new random number each tick. This noise depends on the rate: a faster graph spreads
/// the same power over a wider band, so less of it is felt.
///
/// The same seed gives the same noise on every run. Two nodes that must sound different need different seeds. The generator is
/// Tactus's own (framework/kit/random.hpp), and gives the same bits on all machines.
struct SignalNoise
{
    using Inputs = Empty;

    struct Params
    {
        double amplitude = 1.0;
        double bandwidth = 0.0;
    };

    struct Settings
    {
        int seed = 1;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.noise",
        .name = "Noise",
        .summary = "Gaussian noise that repeats from run to run.",
        .source = "Box & Muller 1958; Steele, Lea & Flood 2014 (splitmix64)",
        .keywords = "random white",
    };

    static constexpr std::tuple ports {
        param (&Params::amplitude, "amplitude", any_unit, "standard deviation", { .hard = { 0, inf }, .usual = { 0, 10 } }),
        param (&Params::bandwidth, "bandwidth", unit::hertz, "upper end of the band; 0: white noise, a new number each tick",
               { .hard = { 0, inf }, .usual = { 0, 1000 } }),
        setting (&Settings::seed, "seed", unit::count, "number that selects the noise", { .hard = { 0, 2147483647.0 }, .usual = { 1, 1000 } }),
        output (&Outputs::out, "out", sameAs ("amplitude"), "the noise"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        white = Random { static_cast<std::uint64_t> (settings.seed) };
        band = BandNoise { static_cast<std::uint64_t> (settings.seed) };
        update();
    }

    void update() noexcept
    {
        portion = std::min (1.0, 2.0 * params.bandwidth * dt);
        level = portion > 0.0 ? std::sqrt (portion / (2.0 * params.bandwidth * dt)) : 1.0;
    }

    Outputs tick (const Inputs&) noexcept
    {
        const double noise = portion > 0.0 ? level * band (portion) : white.normal();
        return { .out = finiteOrZero (params.amplitude * noise) };
    }

    std::string warning (const Setup& setup) const
    {
        if (! (2.0 * params.bandwidth > setup.rate_hz)) return {};
        const auto hertz = [] (double f) { return std::to_string (std::lround (std::min (f, 1e15))); };
        return "at a rate of " + hertz (setup.rate_hz) + " Hz, the noise has only the frequencies below " + hertz (0.5 * setup.rate_hz)
               + " Hz: raise the rate to twice the bandwidth, " + hertz (2.0 * params.bandwidth) + " Hz, or lower the bandwidth";
    }

    Claims claims() const
    {
        const double largest = params.bandwidth > 0.0 ? BandNoise::largest_gain : 1.0;
        return { .amplitude = largest * Random::largest_normal * std::abs (params.amplitude) };
    }

    void serialize (auto& archive) { archive (white, band); }

private:
    Random white;
    BandNoise band;
    double dt = 1.0 / Setup {}.rate_hz;   // s
    double portion = 0.0;                 // 2 bandwidth dt, at most 1; 0: white
    double level = 1.0;                   // RMS of the part of the noise that the rate can render
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalNoise);
