// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Makes a signal larger or smaller.
///
/// To multiply two signals with their units, use signal.multiply.
struct SignalGain
{
    using Inputs = In<double>;

    struct Params
    {
        double gain = 1.0;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.gain",
        .name = "Gain",
        .summary = "Makes a signal larger or smaller.",
        .source = "definition",
        .keywords = "knob amplifier volume level vca",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        param (&Params::gain, "gain", unit::gain, "factor; a negative one inverts the signal", { .usual = { 0, 2 } }),
        output (&Outputs::out, "out", sameAs ("in"), "gain times the signal"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept { return { .out = finiteOrZero (params.gain * in.in) }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalGain);
