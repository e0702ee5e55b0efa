// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/biquad.hpp>
#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The reconstruction filter of a device. It smooths the force of a motor, so that the steps between samples, and vibrations above the
/// first resonance, do not shake the structure.
///
///     H(s) = 1 / (s^2 + sqrt (2) s + 1),  s in units of w_c      on each component
///
/// This is filter.butterworth2 for a vector. All components have the same filter, so the force keeps its direction while only its
/// magnitude changes, and the result does not depend on how the axes are turned. Wire it last, between the sum of all forces and the
/// motor, with a cutoff at the first resonance F_0 of the device or below.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 5; Butterworth 1930.
///
/// Good to know
///  - It delays the force by about 1 / (pi sqrt (2) cutoff) s at low frequencies: 7.5 ms at 30 Hz, 0.56 ms at 400 Hz. For the stability
///    of a wall, this delay counts like ticks of delay: the damping of the device must be at least (2 d + 1) sigma T / 2, where sigma
///    is the stiffness and d T the delay. So filter textures and vibrations, and walls only if they are soft.
///  - The response to a step overshoots by 4 %.
///  - It starts from rest, even after a non-finite input.
struct Reconstruction
{
    using Inputs = In<Vec3>;
    using Params = Cutoff;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "filter.reconstruction",
        .name = "Reconstruction filter",
        .summary = "Smooths a force before it reaches the motor, flat up to its cutoff.",
        .source = "Hayward 2007, section 5; Butterworth 1930",
        .keywords = "lowpass smooth",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector, such as the sum of all forces"),
        lowPassCutoff (&Params::cutoff),
        output (&Outputs::out, "out", sameAs ("in"), "the smoothed vector"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { rate = setup.rate_hz; }

    void update() noexcept { filter = movingButterworth2 (params.cutoff, rate); }

    Outputs tick (const Inputs& in) noexcept
    {
        const Vec3 out { x (filter, in.in.x()), y (filter, in.in.y()), z (filter, in.in.z()) };
        if (isFinite (in.in, out)) return { .out = out };
        x = y = z = {};
        return {};
    }

    void serialize (auto& archive) { archive (x, y, z); }

private:
    double rate = 4000.0;   // Hz
    StateVariable filter;
    StateVariableState x, y, z;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Reconstruction);
