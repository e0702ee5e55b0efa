// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Makes a vector from three signals.
struct VectorJoin
{
    using Inputs = Components;
    using Params = Empty;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "vector.join",
        .name = "Join",
        .summary = "Makes a vector from three signals.",
        .source = "definition",
        .keywords = "pack combine xyz",
    };

    static constexpr std::tuple ports {
        input (&Inputs::x, "x", any_unit, "component to the right"),
        input (&Inputs::y, "y", sameAs ("x"), "component away from the person"),
        input (&Inputs::z, "z", sameAs ("x"), "component upwards"),
        output (&Outputs::out, "out", sameAs ("x"), "the vector"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept { return { .out = finiteOrZero (Vec3 { in.x, in.y, in.z }) }; }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorJoin);
