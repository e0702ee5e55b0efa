// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// The sum of its vectors. An input that nothing is wired to counts as 0.
struct VectorAdd
{
    struct Inputs
    {
        InputList<Vec3> in;
    };

    struct Params
    {
    };

    struct Settings
    {
        int inputs = 2;
    };

    struct Outputs
    {
        Vec3 out = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "vector.add",
        .name = "Add",
        .summary = "Adds vectors up.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vectors", 0.0),
        setting (&Settings::inputs, "inputs", unit::count, "number of inputs", { .hard = { 1, list_capacity }, .usual = { 1, 8 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the sum"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        Vec3 sum = Vec3::Zero();
        for (int i = 0; i < in.in.size(); ++i)
            sum += in.in[i];
        return { .out = finiteOrZero (sum) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorAdd);
