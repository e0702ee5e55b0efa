// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/expression.hpp>
#include <tactus/kit/math/math.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tactus;

namespace
{
double valueOf (const std::string& text, double in0 = 0.0, double in1 = 0.0)
{
    Expression formula;
    INFO (text);
    REQUIRE (formula.compile (text, 2) == "");
    const double* const sources[] { &in0, &in1 };
    return formula (InputList<double> { sources, 2 });
}

std::string problemOf (const std::string& text) { return Expression {}.compile (text, 2); }
}   // namespace

TEST_CASE ("expression: operators have their usual precedence", "[framework][expression]")
{
    CHECK (valueOf ("1 + 2 * 3") == 7.0);
    CHECK (valueOf ("(1 + 2) * 3") == 9.0);
    CHECK (valueOf ("10 - 4 - 3") == 3.0);
    CHECK (valueOf ("24 / 4 / 3") == 2.0);
    CHECK (valueOf ("2 ^ 3 ^ 2") == 512.0);
    CHECK (valueOf ("-2 ^ 2") == -4.0);
    CHECK (valueOf ("2 ^ -1") == 0.5);
    CHECK (valueOf ("- - 3") == 3.0);
    CHECK (valueOf ("2 * -3") == -6.0);
    CHECK (valueOf ("1 + 1 == 2") == 1.0);
    CHECK (valueOf ("1 != 1") == 0.0);
    CHECK (valueOf ("3 <= 3") == 1.0);
    CHECK (valueOf ("3 < 3") == 0.0);
    CHECK (valueOf ("3 >= 4") == 0.0);
    CHECK (valueOf ("4 > 3") == 1.0);
    CHECK (valueOf ("0 ? 1 : 0 ? 2 : 3") == 3.0);
    CHECK (valueOf ("1 ? 0 ? 4 : 5 : 6") == 5.0);
    CHECK (valueOf (" 1.5e-3\t+.5 ") == 0.5015);
}

TEST_CASE ("expression: inputs are in0, in1 or in[0], in[1]", "[framework][expression]")
{
    CHECK (valueOf ("in0 - in1", 5.0, 3.0) == 2.0);
    CHECK (valueOf ("in[0] - in[ 1 ]", 5.0, 3.0) == 2.0);
    CHECK (valueOf ("in1 > 1 ? in0 : -in0", 5.0, 3.0) == 5.0);
}

TEST_CASE ("expression: the branch that is not taken may be invalid", "[framework][expression]")
{
    CHECK (valueOf ("in0 > 0 ? log (in0) : 0", -1.0) == 0.0);
    CHECK (valueOf ("min (1 / in0, 3)", 0.0) == 3.0);
}

TEST_CASE ("expression: functions are those of kit/math and the standard library", "[framework][expression]")
{
    test::property ("at any two numbers", [] {
        const double a = *rc::gen::inRange (-1000, 1000) / 100.0, b = *rc::gen::inRange (-1000, 1000) / 100.0;
        const auto same = [&] (const std::string& text, double wanted) {
            const double got = valueOf (text, a, b);
            RC_ASSERT (got == wanted || (std::isnan (got) && std::isnan (wanted)));
        };
        same ("sin (in0)", math::sin (a));
        same ("cos (in0)", math::cos (a));
        same ("tan (in0)", math::tan (a));
        same ("asin (in0)", math::asin (a));
        same ("acos (in0)", math::acos (a));
        same ("atan (in0)", math::atan (a));
        same ("atan2 (in0, in1)", math::atan2 (a, b));
        same ("sqrt (in0)", std::sqrt (a));
        same ("exp (in0)", math::exp (a));
        same ("log (in0)", math::log (a));
        same ("abs (in0)", std::abs (a));
        same ("min (in0, in1)", std::min (a, b));
        same ("max (in0, in1)", std::max (a, b));
        same ("floor (in0)", std::floor (a));
        same ("ceil (in0)", std::ceil (a));
        same ("sign (in0)", double (a > 0.0) - double (a < 0.0));
        same ("clamp (in0, -2, in1)", a < -2.0 ? -2.0 : std::min (a, b));
        same ("pow (in0, in1)", math::pow (a, b));
        same ("in0 ^ in1", math::pow (a, b));
        same ("pi * in0 + e", std::numbers::pi * a + std::numbers::e);
    });
}

TEST_CASE ("expression: errors are reported with their column", "[framework][expression]")
{
    CHECK (problemOf ("") == "column 1: the formula is empty; the simplest one is in0");
    CHECK (problemOf ("in0 +") == "column 6: expected a value, found the end");
    CHECK (problemOf ("in0 in1") == "column 5: expected an operator or the end, found \"i\"");
    CHECK (problemOf ("2 * (in0 + 1") == "column 13: expected ), found the end");
    CHECK (problemOf ("2 * in2") == "column 5: there is no input 2; the inputs are in0 to in1");
    CHECK (problemOf ("in[7]") == "column 1: there is no input 7; the inputs are in0 to in1");
    CHECK (problemOf ("atan2 (1)") == "column 1: atan2 takes 2 values, but is given 1");
    CHECK (problemOf ("1 + sine (2)").starts_with ("column 5: there is no \"sine\""));
    CHECK (problemOf ("1e999") == "column 1: this number does not fit into a double");
    CHECK (problemOf ("1 ? 2") == "column 6: expected :, found the end");
    CHECK (problemOf ("in0 × 2") == "column 5: expected an operator or the end, found \"×\"");
}

TEST_CASE ("expression: nesting is limited, so that no text can exhaust the stack", "[framework][expression]")
{
    const auto nested = [] (int n, const std::string& open, const std::string& close) {
        std::string text;
        for (int i = 0; i < n; ++i)
            text += open;
        text += "1";
        for (int i = 0; i < n; ++i)
            text += close;
        return text;
    };
    CHECK (valueOf (nested (50, "(", ")")) == 1.0);
    CHECK (problemOf (nested (100'000, "(", ")")).find ("nested too deeply") != std::string::npos);
    CHECK (problemOf (nested (100'000, "-", "")).find ("nested too deeply") != std::string::npos);
    CHECK (problemOf (nested (100'000, "1+(", ")")).find ("nested too deeply") != std::string::npos);
    CHECK (problemOf (nested (100'000, "1?1:", "")).find ("nested too deeply") != std::string::npos);
    CHECK (problemOf (nested (100'000, "2^", "")).find ("nested too deeply") != std::string::npos);
    CHECK (valueOf (nested (1000, "1+", "")) == 1001.0);
}

TEST_CASE ("expression: any text either compiles or is refused", "[framework][expression]")
{
    test::property ("text from its alphabet", [] {
        static const std::string words[] { "in0", "in1", "in[", "]", "(", ")", "+", "-", "*", "/", "^", "?",
                                           ":", "<", "==", ",", "1", "2.5", "pi", "clamp", "min", "sin", " " };
        const auto picks = *rc::gen::container<std::vector<std::size_t>> (rc::gen::inRange<std::size_t> (0, std::size (words)));
        std::string text;
        for (const auto i : picks)
            text += words[i];

        Expression formula;
        const auto problem = formula.compile (text, 2);
        const double one = 1.0;
        const double* const sources[] { &one, &one };
        const double value = formula (InputList<double> { sources, 2 });
        if (! problem.empty()) RC_ASSERT (value == 0.0);
    });
}
