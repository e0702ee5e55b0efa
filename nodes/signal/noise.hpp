// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>
#include <framework/random.hpp>

#include <cmath>
#include <cstdint>

namespace tactus::nodes
{

/// White noise: each tick a new number, Gaussian around 0.
///
/// The same seed gives the same noise on every run; two nodes that must not sound as one need two seeds. The generator is
/// the node's own (framework/random.hpp), the same bits on every machine whose std::log and std::cos agree. White up to
/// half the tick rate, so a faster graph spreads the same power wider; a filter behind it sets the band.
struct SignalNoise
{
    struct Inputs
    {
    };

    struct Params
    {
        double amplitude = 1.0;
    };

    struct Settings
    {
        int seed = 1;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.noise",
        .name = "Noise",
        .summary = "White Gaussian noise that repeats from run to run.",
        .source = "Box & Muller 1958; Steele, Lea & Flood 2014 (splitmix64)",
    };

    static constexpr std::tuple ports {
        param (&Params::amplitude, "amplitude", any_unit, "standard deviation", { .hard = { 0, inf }, .usual = { 0, 10 } }),
        setting (&Settings::seed, "seed", unit::count, "which noise", { .hard = { 0, 2147483647 }, .usual = { 1, 1000 } }),
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
