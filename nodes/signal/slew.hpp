// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Limits how fast a signal changes: steps become ramps.
///
/// The output starts at the first sample, without a ramp from 0, and does so again after a non-finite input. A signal slower than
/// the rate passes unchanged, bit for bit.
struct SignalSlew
{
    using Inputs = In<double>;

    struct Params
    {
        double rate = 1.0;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.slew",
        .name = "Slew limit",
        .summary = "Limits how fast a signal changes.",
        .source = "definition",
        .keywords = "glide portamento lag rate",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        param (&Params::rate, "rate", sameAs ("in", unit::per_second), "fastest change per second, up or down", { .hard = { 0, inf }, .usual = { 0, 100 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the signal, slowed down"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { dt = setup.dt_s(); }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.in, params.rate))
        {
            started = false;
            return {};
        }

        const double step = params.rate * dt;
        if (started && in.in > last + step)
            last += step;
        else if (started && in.in < last - step)
            last -= step;
        else
            last = in.in;

        started = true;
        return { .out = last };
    }

    void serialize (auto& archive) { archive (last, started); }

private:
    double dt = 0.0;   // s
    double last = 0.0;
    bool started = false;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalSlew);
