// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <cmath>

namespace tactus::nodes
{

/// A number that stays where it is put: a knob with an output.
struct SignalConstant
{
    struct Inputs
    {
    };

    struct Params
    {
        double value = 0.0;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.constant",
        .name = "Constant",
        .summary = "Gives a number that stays where it is put.",
        .source = "definition",
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
