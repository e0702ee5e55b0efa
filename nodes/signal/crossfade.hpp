// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// Goes from one signal to another.
///
///     out = (1 - amount) a + amount b
///
/// The weights add up to 1, so two signals that agree pass unchanged. Two that have nothing to do with each other (noises,
/// say) are 3 dB weaker half way.
struct SignalCrossfade
{
    struct Inputs
    {
        double a = 0.0;
        double b = 0.0;
    };

    struct Params
    {
        double amount = 0.0;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.crossfade",
        .name = "Crossfade",
        .summary = "Goes from one signal to another.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::a, "a", any_unit, "signal at amount 0"),
        input (&Inputs::b, "b", sameAs ("a"), "signal at amount 1"),
        param (&Params::amount, "amount", unit::gain, "how far from a to b", { .hard = { 0, 1 } }),
        output (&Outputs::out, "out", sameAs ("a"), "the mixture"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        return { .out = finiteOrZero ((1.0 - params.amount) * in.a + params.amount * in.b) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalCrossfade);
