// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/lanes.hpp>
#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Scales a vector by a signal, units included: a normal times a resistance is a force.
template <typename V>
struct VectorScaleOf
{
    struct Inputs
    {
        Vector<V> in = Vector<V>::Zero();
        V gain = 1.0;
    };

    using Params = Empty;
    using Outputs = Out<Vector<V>>;

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
        const V x = in.gain * in.in.x(), y = in.gain * in.in.y(), z = in.gain * in.in.z();   // as in VectorAdd
        return select (isFinite (x, y, z), Outputs { .out = { x, y, z } }, Outputs {});
    }
};

using VectorScale = VectorScaleOf<double>;

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorScale);
TACTUS_LANES (tactus::nodes::VectorScaleOf);
