// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <cmath>

namespace tactus::nodes
{

/// The absolute value of a signal.
struct SignalAbs
{
    using Inputs = In<double>;
    using Params = Empty;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.abs",
        .name = "Absolute value",
        .summary = "Drops the sign of a signal.",
        .source = "definition",
        .keywords = "rectify magnitude",
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
