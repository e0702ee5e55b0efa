// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The direction of a vector: the same direction with length 1. A vector of length 0 has no direction and stays 0.
///
/// Near 0 the direction is mostly noise. A force made from it needs a window that closes there.
struct VectorNormalize
{
    using Inputs = In<Vec3>;
    using Params = Empty;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "vector.normalize",
        .name = "Normalize",
        .summary = "Gives the direction of a vector.",
        .source = "definition",
        .keywords = "unit",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        output (&Outputs::out, "out", unit::gain, "unit vector in the direction of the input; 0 if the input is 0"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .out = direction (in.in) };
    }

    Claims claims() const { return { .amplitude = 1.0 }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorNormalize);
