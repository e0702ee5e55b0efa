// SPDX-License-Identifier: MIT
#pragma once

#include <framework/biquad.hpp>
#include <framework/node.hpp>

#include <cmath>
#include <numbers>

namespace tactus::nodes
{

/// Takes the edge off a signal: a first-order low-pass, as a resistor and a capacitor.
///
///     H(s) = 1 / (1 + s / w_c)      6 dB per octave, -3 dB at the cutoff, gain 1 at rest
///
/// made digital by the bilinear transform, prewarped so that the cutoff is where it is asked for; half the tick rate is
/// lost completely. Costs delay: about 1 / (2 pi cutoff) s at low frequencies, which in a loop through the hand costs
/// stiffness. A cutoff is held between 1e-6 and 0.4999 of the tick rate. It starts from rest, also after a non-finite input.
///
/// Source: Oppenheim & Schafer, Discrete-Time Signal Processing, bilinear transformation.
struct OnePole
{
    struct Inputs
    {
        double in = 0.0;
    };

    struct Params
    {
        double cutoff = 100.0;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "filter.one_pole",
        .name = "One-pole low-pass",
        .summary = "Smooths a signal gently.",
        .source = "Oppenheim & Schafer, bilinear transformation",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        param (&Params::cutoff, "cutoff", unit::hertz, "where it is 3 dB down", { .hard = { 0, inf }, .usual = { 1, 1000 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the smoothed signal"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { rate = setup.rate_hz; }

    void update() noexcept
    {
        const double k = std::tan (std::numbers::pi * usableCutoff (params.cutoff, rate) / rate);
        b = k / (1.0 + k);
        a = (k - 1.0) / (k + 1.0);
    }

    /// The biquad's form with what a first order leaves of it, and its rules: a sample it cannot digest gives 0.
    Outputs tick (const Inputs& in) noexcept
    {
        const double out = b * in.in + s;
        s = b * in.in - a * out;
        if (! isFinite (s))   // nor is it, if `out` is not
        {
            s = 0.0;
            return {};
        }
        if (std::abs (s) < BiquadState::silence) s = 0.0;
        return { .out = out };
    }

private:
    double rate = 4000.0;   // Hz
    double b = 1.0, a = 0.0, s = 0.0;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::OnePole);
