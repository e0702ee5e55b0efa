// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The sum of its vectors. An unwired input counts as 0.
struct VectorAdd
{
    using Inputs = In<InputList<Vec3>>;
    using Params = Empty;
    using Settings = InputCount;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "vector.add",
        .name = "Add",
        .summary = "Adds vectors.",
        .source = "definition",
        .keywords = "sum plus",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vectors", 0.0),
        inputCount (&Settings::inputs),
        output (&Outputs::out, "out", sameAs ("in"), "the sum"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        double x = 0.0, y = 0.0, z = 0.0;   // GCC keeps these in registers; a Vec3 would go through memory
        for (int i = 0; i < in.in.size(); ++i)
        {
            const Vec3 v = in.in[i];
            x += v.x();
            y += v.y();
            z += v.z();
        }
        if (! isFinite (x, y, z)) return {};
        return { .out = { x, y, z } };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorAdd);
