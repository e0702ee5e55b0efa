// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// Makes a vector of three signals.
struct VectorJoin
{
    struct Inputs
    {
        double x = 0.0;
        double y = 0.0;
        double z = 0.0;
    };

    struct Params
    {
    };

    struct Outputs
    {
        Vec3 out = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "vector.join",
        .name = "Join",
        .summary = "Makes a vector of three signals.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::x, "x", any_unit, "part to the right"),
        input (&Inputs::y, "y", sameAs ("x"), "part away from the person"),
        input (&Inputs::z, "z", sameAs ("x"), "part upwards"),
        output (&Outputs::out, "out", sameAs ("x"), "the vector"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept { return { .out = finiteOrZero (Vec3 { in.x, in.y, in.z }) }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorJoin);
