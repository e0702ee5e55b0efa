// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/generic.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tactus::nodes
{

/// An oscillator for slow movements and for test signals.
///
///     out = offset + amplitude * shape (f t + phase / 2 pi)
///
///     sine      starts at 0, rising
///     triangle  starts at 0, rising
///     square    +1 for the first half of the cycle, -1 for the second
///     saw       from 0 up to 1, jumps to -1 in mid-cycle, rises back to 0
///
/// The first sample is at `phase`. The phase is computed from the number of ticks, so errors do not accumulate: after a day at
/// a fixed frequency the phase is still correct to the rounding of the number of cycles. A new frequency continues from the
/// current phase. The corners are not smoothed and alias near half the tick rate; use vibration.* and texture.* there.
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

    using Inputs = Empty;

    struct Params
    {
        double frequency = 1.0;
        double amplitude = 1.0;
        double offset = 0.0;
        double phase = 0.0;
        Shape shape = Shape::sine;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.lfo",
        .name = "LFO",
        .summary = "A slow oscillator.",
        .source = "definition",
        .keywords = "sine oscillator wave triangle square",
    };

    static constexpr std::tuple ports {
        param (&Params::frequency, "frequency", unit::hertz, "cycles per second; a negative frequency runs backwards", { .usual = { 0, 100 } }),
        param (&Params::amplitude, "amplitude", any_unit, "largest deviation from the offset", { .usual = { 0, 10 } }),
        param (&Params::offset, "offset", sameAs ("amplitude"), "middle of the oscillation", { .usual = { -10, 10 } }),
        param (&Params::phase, "phase", unit::radian, "where in the cycle it starts", { .usual = { -2 * std::numbers::pi, 2 * std::numbers::pi } }),
        choice (&Params::shape, "shape", shape_names, "waveform"),
        output (&Outputs::out, "out", sameAs ("amplitude"), "the oscillation"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { rate = setup.rate_hz; }

    void update() noexcept
    {
        if (params.frequency == frequency) return;
        start = finiteOrZero (fraction (cycle()));
        ticks = 0;
        frequency = finiteOrZero (params.frequency);
    }

    Outputs tick (const Inputs&) noexcept
    {
        const double x = shaped (fraction (cycle() + params.phase / (2.0 * std::numbers::pi)));
        ++ticks;
        return { .out = finiteOrZero (params.offset + params.amplitude * x) };
    }

    Claims claims() const { return { .amplitude = std::abs (params.offset) + std::abs (params.amplitude) }; }

    void serialize (auto& archive) { archive (frequency, start, ticks); }

private:
    static double fraction (double cycles) noexcept { return cycles - std::floor (cycles); }

    Fine cycle() const noexcept { return start + frequency * static_cast<double> (ticks) / rate; }

    double shaped (double t) const noexcept
    {
        switch (params.shape)
        {
        case Shape::sine:
            return math::sin (2.0 * std::numbers::pi * t);
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
    double frequency = 0.0;    // Hz; the frequency in use
    double start = 0.0;        // phase at which this frequency began, in cycles
    std::uint64_t ticks = 0;   // ticks at this frequency
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalLfo);
