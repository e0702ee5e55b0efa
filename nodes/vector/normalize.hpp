// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// Where a vector points: the same direction with length 1. A vector of length 0 points nowhere and stays 0.
///
/// Near 0 the direction is mostly noise: a force made of it needs a window that closes there.
struct VectorNormalize
{
    struct Inputs
    {
        Vec3 in = Vec3::Zero();
    };

    struct Params
    {
    };

    struct Outputs
    {
        Vec3 out = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "vector.normalize",
        .name = "Normalize",
        .summary = "Gives the direction of a vector.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        output (&Outputs::out, "out", unit::gain, "its direction, of length 1, or 0"),
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
