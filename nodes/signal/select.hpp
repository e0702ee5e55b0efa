// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::nodes
{

/// Passes one of its inputs on, by number, counted from 0.
///
/// The number is rounded to the nearest, so that 0.9999 out of a calculation still means 1, and held to the inputs there
/// are. It switches hard; signal.crossfade goes gently.
struct SignalSelect
{
    struct Inputs
    {
        InputList<double> in;
    };

    struct Params
    {
        double index = 0.0;
    };

    struct Settings
    {
        int inputs = 2;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.select",
        .name = "Select",
        .summary = "Passes one of several signals on.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signals to choose from", 0.0),
        param (&Params::index, "index", unit::count, "which of them, from 0", { .hard = { 0, list_capacity - 1 }, .usual = { 0, 7 } }),
        setting (&Settings::inputs, "inputs", unit::count, "number of inputs", { .hard = { 1, list_capacity }, .usual = { 1, 8 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the chosen signal"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (in.in.size() == 0 || ! isFinite (in.in) || ! isFinite (params.index)) return {};
        const double last = in.in.size() - 1;
        return { .out = in.in[static_cast<int> (std::clamp (std::floor (params.index + 0.5), 0.0, last))] };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalSelect);
