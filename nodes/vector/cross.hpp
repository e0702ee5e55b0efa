// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <Eigen/Geometry>

namespace tactus::nodes
{

/// The cross product, right-handed: at right angles to both vectors. Lever cross force is torque.
struct VectorCross
{
    using Inputs = Pair<Vec3>;
    using Params = Empty;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "vector.cross",
        .name = "Cross product",
        .summary = "Multiplies two vectors; the result is at right angles to both.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::a, "a", any_unit, "first vector"),
        input (&Inputs::b, "b", any_unit, "second vector"),
        output (&Outputs::out, "out", productOf ("a", "b"), "a cross b"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.a, in.b)) return {};
        return { .out = finiteOrZero (Vec3 { in.a.cross (in.b) }) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorCross);
