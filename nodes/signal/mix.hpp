// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The sum of its inputs, each with its own gain.
///
/// For mute, solo and priorities use layer.mix.
struct SignalMix
{
    using Inputs = In<InputList<double>>;

    struct Params
    {
        List gain { 1.0 };
    };

    using Settings = InputCount;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.mix",
        .name = "Mix",
        .summary = "Adds signals, each with its own gain.",
        .source = "definition",
        .keywords = "mixer sum",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signals", 0.0),
        param (&Params::gain, "gain", unit::gain, "factor on the input with the same number", { .usual = { 0, 2 } }),
        inputCount (&Settings::inputs),
        output (&Outputs::out, "out", sameAs ("in"), "the sum of gain times input"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        double sum = 0.0;
        for (int i = 0; i < in.in.size(); ++i)
            sum += params.gain[i] * in.in[i];
        return { .out = finiteOrZero (sum) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalMix);
