// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// The sum of its inputs, each with a gain of its own.
///
/// layer.mix is the one with mute, solo and priorities.
struct SignalMix
{
    struct Inputs
    {
        InputList<double> in;
    };

    struct Params
    {
        List gain { 1.0 };
    };

    struct Settings
    {
        int inputs = 2;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.mix",
        .name = "Mix",
        .summary = "Adds signals up, each with its own gain.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signals", 0.0),
        param (&Params::gain, "gain", unit::gain, "factor on the input of the same number", { .usual = { 0, 2 } }),
        setting (&Settings::inputs, "inputs", unit::count, "number of inputs", { .hard = { 1, list_capacity }, .usual = { 1, 8 } }),
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
