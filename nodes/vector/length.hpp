// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>
#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The length of a vector.
struct VectorLength
{
    using Inputs = In<Vec3>;
    using Params = Empty;
    using Outputs = Amount<double>;

    static constexpr Info info {
        .id = "vector.length",
        .name = "Length",
        .summary = "The length of a vector.",
        .source = "definition",
        .keywords = "norm magnitude",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        output (&Outputs::amount, "amount", sameAs ("in"), "its length, never negative"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .amount = finiteOrZero (length (in.in)) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorLength);
