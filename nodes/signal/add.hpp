// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The sum of its inputs. An unwired input counts as 0.
///
/// A non-finite input silences the whole sum, not only its own part.
struct SignalAdd
{
    using Inputs = In<InputList<double>>;
    using Params = Empty;
    using Settings = InputCount;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.add",
        .name = "Add",
        .summary = "Adds signals.",
        .source = "definition",
        .keywords = "sum plus",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signals", 0.0),
        inputCount (&Settings::inputs),
        output (&Outputs::out, "out", sameAs ("in"), "the sum"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        double sum = 0.0;
        for (int i = 0; i < in.in.size(); ++i)
            sum += in.in[i];
        return { .out = finiteOrZero (sum) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalAdd);
