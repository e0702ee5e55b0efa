// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Fades from one signal to another.
///
///     out = (1 - amount) a + amount b
///
/// The weights add up to 1, so two identical signals pass unchanged. Two unrelated signals, such as noises, are 3 dB
/// weaker halfway.
struct SignalCrossfade
{
    using Inputs = Pair<double>;
    using Params = Amount<double>;
    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.crossfade",
        .name = "Crossfade",
        .summary = "Fades from one signal to another.",
        .source = "definition",
        .keywords = "blend morph",
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
