// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tactus::nodes
{

/// An oscillator for slow movement, and for test signals.
///
///     out = offset + amplitude * shape (f t + phase / 2 pi)
///
///     sine      from 0, upwards first
///     triangle  likewise
///     square    +1 for the first half of the turn, -1 for the second
///     saw       from 0 up to 1, jumps to -1 in the middle of the turn, up to 0
///
/// The first sample is at `phase`. Turns are counted from whole ticks, so that nothing adds up: after a day at a fixed
/// frequency the phase is still right to a rounding of the number of turns. A new frequency goes on from the phase reached.
/// The corners are not smoothed: near half the tick rate they alias; vibration.* and texture.* are made for that.
struct SignalLfo
{
    enum class Shape
    {
        sine,
        triangle,
        square,
        saw
    };

    static constexpr std::string_view shape_names[] { "sine", "triangle", "square", "saw" };

    struct Inputs
    {
    };

    struct Params
    {
        double frequency = 1.0;
        double amplitude = 1.0;
        double offset = 0.0;
        double phase = 0.0;
        Shape shape = Shape::sine;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.lfo",
        .name = "LFO",
        .summary = "A slow oscillator.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        param (&Params::frequency, "frequency", unit::hertz, "turns per second; negative turns backwards", { .usual = { 0, 100 } }),
        param (&Params::amplitude, "amplitude", any_unit, "largest deviation from the offset", { .usual = { 0, 10 } }),
        param (&Params::offset, "offset", sameAs ("amplitude"), "middle of the movement", { .usual = { -10, 10 } }),
        param (&Params::phase, "phase", unit::radian, "where in the turn it starts", { .usual = { -2 * std::numbers::pi, 2 * std::numbers::pi } }),
        choice (&Params::shape, "shape", shape_names, "form of the movement"),
        output (&Outputs::out, "out", sameAs ("amplitude"), "the oscillation"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { rate = setup.rate_hz; }

    void update() noexcept
    {
        if (params.frequency == frequency) return;
        start = finiteOrZero (fraction (turn()));
        ticks = 0;
        frequency = finiteOrZero (params.frequency);
    }

    Outputs tick (const Inputs&) noexcept
    {
        const double x = shaped (fraction (turn() + params.phase / (2.0 * std::numbers::pi)));
        ++ticks;
        return { .out = finiteOrZero (params.offset + params.amplitude * x) };
    }

    Claims claims() const { return { .amplitude = std::abs (params.offset) + std::abs (params.amplitude) }; }

private:
    static double fraction (double turns) noexcept { return turns - std::floor (turns); }

    double turn() const noexcept { return start + frequency * static_cast<double> (ticks) / rate; }

    double shaped (double t) const noexcept
    {
        switch (params.shape)
        {
        case Shape::sine:
            return std::sin (2.0 * std::numbers::pi * t);
        case Shape::triangle:
            return 4.0 * std::abs (fraction (t + 0.75) - 0.5) - 1.0;
        case Shape::square:
            return t < 0.5 ? 1.0 : -1.0;
        case Shape::saw:
            return 2.0 * (t < 0.5 ? t : t - 1.0);
        }
        return 0.0;
    }

    double rate = 1.0;         // Hz
    double frequency = 0.0;    // Hz, since `start`
    double start = 0.0;        // turn at which this frequency began
    std::uint64_t ticks = 0;   // since then
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalLfo);
