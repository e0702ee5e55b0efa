// SPDX-License-Identifier: MIT
#pragma once

#include "list.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// A formula over in0, in1, …, compiled to a short program that runs without allocating.
///
///     in0 * 2 + sin (2*pi*in1)        in0 > 0.1 ? in1 : -in1 ^ 2        clamp (in[0], -1, 1)
///
/// From loosest to tightest: ?:, == != < <= > >=, + -, * /, unary -, ^ (from the right: 2^3^2 is 2^9, -2^2 is -4).
/// Constants: pi, e. A comparison gives 1 or 0. A condition holds unless it is 0. Both branches of ?: are computed.
/// Functions: sin cos tan asin acos atan sqrt exp log abs floor ceil sign (x), atan2 pow min max (x, y),
/// clamp (x, low, high).
class Expression
{
public:
    /// The deepest nesting of a formula, in brackets and in values on the stack. Deeper formulas are refused.
    static constexpr int max_depth = 64;

    /// Replaces the formula, which may use `inputs` inputs. Returns "", or what is wrong and in which column.
    /// After an error the formula is empty, and an empty formula gives 0.                        [main thread]
    std::string compile (std::string_view text, int inputs);

    /// The value, as IEEE arithmetic gives it: 1/0 is infinite.                                   [tick thread]
    double operator() (const InputList<double>& in) const noexcept;

private:
    friend class ExpressionParser;

    enum class Op
    {
        constant,
        input,
        negate,
        add,
        subtract,
        multiply,
        divide,
        power,
        equal,
        unequal,
        less,
        less_equal,
        greater,
        greater_equal,
        choose,
        sin,
        cos,
        tan,
        asin,
        acos,
        atan,
        sqrt,
        exp,
        log,
        abs,
        floor,
        ceil,
        sign,
        atan2,
        min,
        max,
        clamp
    };

    struct Step
    {
        Op op;
        int input = 0;        // for Op::input: number of the input
        double value = 0.0;   // for Op::constant: its value
    };

    static int operandsOf (Op) noexcept;
    static double result (const Step&, const double* operands, const InputList<double>& in) noexcept;

    std::vector<Step> program;   // in postfix order
};

}   // namespace tactus
