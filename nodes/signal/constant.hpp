// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <cmath>

namespace tactus::nodes
{

/// A constant number: a knob with an output.
struct SignalConstant
{
    using Inputs = Empty;

    struct Params
    {
        double value = 0.0;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.constant",
        .name = "Constant",
        .summary = "Gives a constant number.",
        .source = "definition",
        .keywords = "knob slider number value",
    };

    static constexpr std::tuple ports {
        param (&Params::value, "value", any_unit, "the number", { .usual = { -1, 1 } }),
        output (&Outputs::out, "out", sameAs ("value"), "the number"),
    };

    Params params;

    Outputs tick (const Inputs&) const noexcept { return { .out = finiteOrZero (params.value) }; }

    Claims claims() const { return { .amplitude = std::abs (params.value) }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalConstant);
