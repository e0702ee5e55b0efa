// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The product of its inputs, units included. An unwired input counts as 1.
///
/// This is the amplifier of a modular synthesiser: a vibration times an envelope, a force times a contact window.
struct SignalMultiply
{
    using Inputs = In<InputList<double>>;
    using Params = Empty;
    using Settings = InputCount;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.multiply",
        .name = "Multiply",
        .summary = "Multiplies signals.",
        .source = "definition",
        .keywords = "vca product modulator",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", each_its_unit, "signals", 1.0),
        inputCount (&Settings::inputs),
        output (&Outputs::out, "out", productOf ("in"), "the product"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        double product = 1.0;
        for (int i = 0; i < in.in.size(); ++i)
            product *= in.in[i];
        return { .out = finiteOrZero (product) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalMultiply);
