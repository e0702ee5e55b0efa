// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::nodes
{

/// Limits a signal to a range. If the lower bound is above the upper one, the upper one takes precedence.
///
/// The limit is hard: a vibration that runs into it gains harmonics.
struct SignalClamp
{
    using Inputs = In<double>;

    struct Params
    {
        double min = -1.0;
        double max = 1.0;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.clamp",
        .name = "Clamp",
        .summary = "Limits a signal to a range.",
        .source = "definition",
        .keywords = "limit saturate minimum maximum",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        param (&Params::min, "min", sameAs ("in"), "lower bound", { .usual = { -10, 10 } }),
        param (&Params::max, "max", sameAs ("in"), "upper bound", { .usual = { -10, 10 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the signal within the bounds"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .out = finiteOrZero (std::min (std::max (in.in, params.min), params.max)) };
    }

    Claims claims() const { return { .amplitude = std::max (std::abs (params.min), std::abs (params.max)) }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalClamp);
