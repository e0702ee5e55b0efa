// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <cmath>

namespace tactus::nodes
{

/// How long a vector is.
struct VectorLength
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
        double amount = 0.0;
    };

    static constexpr Info info {
        .id = "vector.length",
        .name = "Length",
        .summary = "How long a vector is.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        output (&Outputs::amount, "amount", sameAs ("in"), "its length, never negative"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .amount = finiteOrZero (std::hypot (in.in.x(), in.in.y(), in.in.z())) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorLength);
