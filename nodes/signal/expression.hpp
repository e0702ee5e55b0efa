// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/expression.hpp>
#include <tactus/node/generic.hpp>

#include <string>

namespace tactus::nodes
{

/// A formula of its inputs, for anything that no other node does: in0 * abs (in1) + 0.2
///
/// A formula may contain in0, in1, … or in[0], in[1], …, numbers, pi, e, + - * / ^, comparisons, ?:, and the usual functions;
/// framework/kit/expression.hpp has the grammar. It is compiled before the first tick. A formula that does not parse is an error
/// of the graph and is reported with its column. A result that is not finite is given as 0. Units cannot be followed through a
/// formula: any input may be wired, and the output fits anywhere.
struct SignalExpression
{
    using Inputs = In<InputList<double>>;
    using Params = Empty;

    struct Settings
    {
        int inputs = 2;
        std::string text = "in0";
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.expression",
        .name = "Expression",
        .summary = "Computes a formula of its inputs.",
        .source = "definition",
        .keywords = "formula math function code",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", each_its_unit, "values of in0, in1, … in the formula", 0.0),
        inputCount (&Settings::inputs),
        setting (&Settings::text, "text", unit::count, "the formula"),
        output (&Outputs::out, "out", any_unit, "value of the formula"),
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
