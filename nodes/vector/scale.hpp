// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Scales a vector by a signal, units included: a normal times a resistance is a force.
struct VectorScale
{
    struct Inputs
    {
        Vec3 in = Vec3::Zero();
        double gain = 1.0;
    };

    using Params = Empty;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "vector.scale",
        .name = "Scale",
        .summary = "Multiplies a vector by a signal.",
        .source = "definition",
        .keywords = "gain multiply",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        input (&Inputs::gain, "gain", any_unit, "factor; a negative one reverses the vector"),
        output (&Outputs::out, "out", productOf ("in", "gain"), "gain times the vector"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        const double x = in.gain * in.in.x(), y = in.gain * in.in.y(), z = in.gain * in.in.z();   // as in VectorAdd
        if (! isFinite (x, y, z)) return {};
        return { .out = { x, y, z } };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorScale);
