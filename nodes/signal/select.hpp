// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::nodes
{

/// Passes on one of its inputs, chosen by a number that counts from 0.
///
/// The number is rounded to the nearest integer, so that a computed 0.9999 means 1, and limited to the inputs that exist. The
/// switch is hard; signal.crossfade is gradual.
struct SignalSelect
{
    using Inputs = In<InputList<double>>;

    struct Params
    {
        double index = 0.0;
    };

    using Settings = InputCount;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.select",
        .name = "Select",
        .summary = "Passes on one of several signals.",
        .source = "definition",
        .keywords = "switch multiplexer",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signals to choose from", 0.0),
        param (&Params::index, "index", unit::count, "number of the chosen signal, from 0", { .hard = { 0, list_capacity - 1 }, .usual = { 0, 7 } }),
        inputCount (&Settings::inputs),
        output (&Outputs::out, "out", sameAs ("in"), "the chosen signal"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (in.in.size() == 0 || ! isFinite (in.in) || ! isFinite (params.index)) return {};
        const double last = in.in.size() - 1;
        return { .out = in.in[static_cast<int> (std::clamp (std::floor (params.index + 0.5), 0.0, last))] };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalSelect);
