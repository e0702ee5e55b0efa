// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// Takes a vector apart.
struct VectorSplit
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
        double x = 0.0;
        double y = 0.0;
        double z = 0.0;
    };

    static constexpr Info info {
        .id = "vector.split",
        .name = "Split",
        .summary = "Takes a vector apart.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        output (&Outputs::x, "x", sameAs ("in"), "its part to the right"),
        output (&Outputs::y, "y", sameAs ("in"), "its part away from the person"),
        output (&Outputs::z, "z", sameAs ("in"), "its part upwards"),
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
