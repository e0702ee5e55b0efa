// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/random.hpp>
#include <tactus/node/generic.hpp>

#include <cmath>
#include <cstdint>

namespace tactus::nodes
{

/// White noise: a new Gaussian random number around 0 each tick.
///
/// The same seed gives the same noise on every run. Two nodes that must sound different need two seeds. The generator is the
/// node's own (framework/kit/random.hpp); it gives the same bits on every machine whose std::log and std::cos agree. The noise
/// is white up to half the tick rate, so a faster graph spreads the same power over a wider band; a filter after it sets the
/// band.
struct SignalNoise
{
    using Inputs = Empty;

    struct Params
    {
        double amplitude = 1.0;
    };

    struct Settings
    {
        int seed = 1;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.noise",
        .name = "Noise",
        .summary = "White Gaussian noise that repeats from run to run.",
        .source = "Box & Muller 1958; Steele, Lea & Flood 2014 (splitmix64)",
    };

    static constexpr std::tuple ports {
        param (&Params::amplitude, "amplitude", any_unit, "standard deviation", { .hard = { 0, inf }, .usual = { 0, 10 } }),
        setting (&Settings::seed, "seed", unit::count, "number that selects the noise", { .hard = { 0, 2147483647 }, .usual = { 1, 1000 } }),
        output (&Outputs::out, "out", sameAs ("amplitude"), "the noise"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup&) noexcept { random = Random { static_cast<std::uint64_t> (settings.seed) }; }

    Outputs tick (const Inputs&) noexcept { return { .out = finiteOrZero (params.amplitude * random.normal()) }; }

    Claims claims() const { return { .amplitude = Random::largest_normal * std::abs (params.amplitude) }; }

private:
    Random random;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalNoise);
