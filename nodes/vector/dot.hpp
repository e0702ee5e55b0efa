// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// The dot product: how much of one vector lies along the other, times the length of that. Force dot velocity is power.
struct VectorDot
{
    struct Inputs
    {
        Vec3 a = Vec3::Zero();
        Vec3 b = Vec3::Zero();
    };

    struct Params
    {
    };

    struct Outputs
    {
        double amount = 0.0;
    };

    static constexpr Info info {
        .id = "vector.dot",
        .name = "Dot product",
        .summary = "Multiplies two vectors to a number.",
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
