// SPDX-License-Identifier: MIT
#pragma once

#include <framework/expression.hpp>
#include <framework/node.hpp>

#include <string>

namespace tactus::nodes
{

/// A formula over its inputs, for what no other node does: in0 * abs (in1) + 0.2
///
/// What may stand in it is said in framework/expression.hpp: in0, in1, … or in[0], in[1], …, numbers, pi, e, + - * / ^,
/// comparisons, ?:, and the usual functions. It is compiled before the first tick; a text that does not parse is an error
/// of the graph, with its column. A result that is not finite is given as 0. Units cannot be followed through a formula:
/// any input may be wired, and the output fits anywhere.
struct SignalExpression
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
        std::string text = "in0";
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.expression",
        .name = "Expression",
        .summary = "Computes a formula of its inputs.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", each_its_unit, "in0, in1, … of the formula", 0.0),
        setting (&Settings::inputs, "inputs", unit::count, "number of inputs", { .hard = { 1, list_capacity }, .usual = { 1, 8 } }),
        setting (&Settings::text, "text", unit::count, "the formula"),
        output (&Outputs::out, "out", any_unit, "its value"),
    };

    Params params;
    Settings settings;

    std::string problem() const { return Expression {}.compile (settings.text, settings.inputs); }

    void prepare (const Setup&) { formula.compile (settings.text, settings.inputs); }

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .out = finiteOrZero (formula (in.in)) };
    }

private:
    Expression formula;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalExpression);
