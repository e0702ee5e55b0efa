// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/biquad.hpp>
#include <tactus/node/generic.hpp>

#include <cmath>

namespace tactus::nodes
{

/// A gentle low-pass of first order, like a resistor and a capacitor.
///
///     H(s) = 1 / (1 + s / w_c)      6 dB per octave, -3 dB at the cutoff, gain 1 at rest
///
/// discretised by the bilinear transform, prewarped so that the cutoff is exact; a signal at half the tick rate is removed
/// completely. The delay is about 1 / (2 pi cutoff) s at low frequencies, which, in a loop through the hand, lowers the largest
/// stable stiffness. The cutoff is limited to 1e-6 … 0.4999 of the tick rate. The filter starts from rest, even after a
/// non-finite input.
///
/// Source: Oppenheim & Schafer, Discrete-Time Signal Processing, bilinear transformation.
struct OnePole
{
    using Inputs = In<double>;
    using Params = Cutoff;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "filter.one_pole",
        .name = "One-pole low-pass",
        .summary = "Smooths a signal gently.",
        .source = "Oppenheim & Schafer, bilinear transformation",
        .keywords = "lowpass smooth lag",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        lowPassCutoff (&Params::cutoff),
        output (&Outputs::out, "out", sameAs ("in"), "the smoothed signal"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { rate = setup.rate_hz; }

    void update() noexcept
    {
        const double k = prewarped (params.cutoff, rate);
        b = k / (1.0 + k);
        a = (k - 1.0) / (k + 1.0);
    }

    /// Transposed direct form II. In first order it is stable while the cutoff moves: |s| is at most the largest input, and |out| at most twice
    /// that. A sample that would make the state non-finite gives 0.
    Outputs tick (const Inputs& in) noexcept
    {
        const double out = b * in.in + s;
        s = b * in.in - a * out;
        if (! isFinite (s))   // true also if `out` is not finite
        {
            s = 0.0;
            return {};
        }
        if (std::abs (s) < BiquadState::silence) s = 0.0;
        return { .out = out };
    }

    void serialize (auto& archive) { archive (s); }

private:
    double rate = 4000.0;   // Hz
    double b = 1.0, a = 0.0, s = 0.0;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::OnePole);
