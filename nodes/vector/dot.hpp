// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The dot product: how much of one vector lies along the other, times the length of the other. Force dot velocity is power.
struct VectorDot
{
    using Inputs = Pair<Vec3>;
    using Params = Empty;
    using Outputs = Amount<double>;

    static constexpr Info info {
        .id = "vector.dot",
        .name = "Dot product",
        .summary = "Multiplies two vectors; the result is a number.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::a, "a", any_unit, "one vector"),
        input (&Inputs::b, "b", any_unit, "the other"),
        output (&Outputs::amount, "amount", productOf ("a", "b"), "their dot product"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept { return { .amount = finiteOrZero (in.a.dot (in.b)) }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorDot);
