// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <tactus/kit/signal/biquad.hpp>
#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The flattest second-order low-pass: it rebuilds a smooth force from samples.
///
///     H(s) = 1 / (s^2 + sqrt (2) s + 1),  s in units of w_c      12 dB per octave, -3 dB at the cutoff, gain 1 at rest
///
/// discretised by the bilinear transform, prewarped so that the cutoff is exact. With a cutoff at or below the first resonance
/// of a device, it keeps textures from exciting that resonance. A step overshoots by 4 %. The delay is about
/// sqrt (2) / (2 pi cutoff) s at low frequencies. The cutoff is limited to 1e-6 … 0.4999 of the tick rate. The filter starts from
/// rest, even after a non-finite input. The cutoff may move at any speed. For a vector, such as the force of a motor, see filter.reconstruction.
///
/// Source: Butterworth 1930; Hayward 2007, section 5 (reconstruction filter).
struct Butterworth2
{
    using Inputs = In<double>;
    using Params = Cutoff;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "filter.butterworth2",
        .name = "Butterworth low-pass",
        .summary = "Smooths a signal, flat up to its cutoff.",
        .source = "Butterworth 1930; Hayward 2007, section 5",
        .keywords = "lowpass smooth vcf",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        lowPassCutoff (&Params::cutoff),
        output (&Outputs::out, "out", sameAs ("in"), "the smoothed signal"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { rate = setup.rate_hz; }

    void update() noexcept { filter = movingButterworth2 (params.cutoff, rate); }

    Outputs tick (const Inputs& in) noexcept { return { .out = state (filter, in.in) }; }

    void serialize (auto& archive) { archive (state); }

private:
    double rate = 4000.0;   // Hz
    StateVariable filter;
    StateVariableState state;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Butterworth2);
