// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// The sum of its inputs. An input that nothing is wired to counts as 0.
///
/// A non-finite input silences the sum, not only its own part of it: what is wrong should not be half heard.
struct SignalAdd
{
    struct Inputs
    {
        InputList<double> in;
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
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.add",
        .name = "Add",
        .summary = "Adds signals up.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signals", 0.0),
        setting (&Settings::inputs, "inputs", unit::count, "number of inputs", { .hard = { 1, list_capacity }, .usual = { 1, 8 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the sum"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        double sum = 0.0;
        for (int i = 0; i < in.in.size(); ++i)
            sum += in.in[i];
        return { .out = finiteOrZero (sum) };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalAdd);
