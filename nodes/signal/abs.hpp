// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <cmath>

namespace tactus::nodes
{

/// How large a signal is, whatever its sign.
struct SignalAbs
{
    struct Inputs
    {
        double in = 0.0;
    };

    struct Params
    {
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.abs",
        .name = "Absolute value",
        .summary = "Drops the sign of a signal.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        output (&Outputs::out, "out", sameAs ("in"), "the signal without its sign"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept { return { .out = finiteOrZero (std::abs (in.in)) }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalAbs);
