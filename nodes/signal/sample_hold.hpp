// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Holds the value a signal had at the last hit.
///
/// It takes the signal on the tick of the hit itself and gives 0 until the first hit. A nan is not a hit. On a non-finite input
/// it gives 0 for that tick and keeps the held value.
struct SignalSampleHold
{
    struct Inputs
    {
        double in = 0.0;
        double hit = 0.0;
    };

    using Params = Empty;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.sample_hold",
        .name = "Sample and hold",
        .summary = "Holds the value a signal had at the last hit.",
        .source = "definition",
        .keywords = "latch",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        input (&Inputs::hit, "hit", unit::hit, "samples the signal while this is positive"),
        output (&Outputs::out, "out", sameAs ("in"), "the signal at the last hit"),
    };

    Params params;

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.in, in.hit)) return {};
        if (in.hit > 0.0) held = in.in;
        return { .out = held };
    }

    void serialize (auto& archive) { archive (held); }

private:
    double held = 0.0;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalSampleHold);
