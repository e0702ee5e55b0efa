// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::nodes
{

/// Holds a signal between two bounds. If they are crossed, the upper one counts.
///
/// It cuts hard, which is heard as harmonics when a vibration runs into it.
struct SignalClamp
{
    struct Inputs
    {
        double in = 0.0;
    };

    struct Params
    {
        double min = -1.0;
        double max = 1.0;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.clamp",
        .name = "Clamp",
        .summary = "Holds a signal between two bounds.",
        .source = "definition",
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
