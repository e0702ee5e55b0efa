// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Splits a vector into its components.
struct VectorSplit
{
    using Inputs = In<Vec3>;
    using Params = Empty;
    using Outputs = Components;

    static constexpr Info info {
        .id = "vector.split",
        .name = "Split",
        .summary = "Splits a vector into its components.",
        .source = "definition",
        .keywords = "unpack xyz",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        output (&Outputs::x, "x", sameAs ("in"), "its component to the right"),
        output (&Outputs::y, "y", sameAs ("in"), "its component away from the person"),
        output (&Outputs::z, "z", sameAs ("in"), "its component upwards"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .x = in.in.x(), .y = in.in.y(), .z = in.in.z() };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorSplit);
