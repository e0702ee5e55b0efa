// SPDX-License-Identifier: MIT
// The strings that have a unit of some dimension, as a regular expression. Products of one or two units with powers up to two are checked; of
// others only the units are, because there are too many.
#include "schema_parts.hpp"

#include <tactus/text/units.hpp>

#include <array>
#include <cmath>

namespace tactus::schema
{

namespace
{
const std::string number = "[-+]?(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[eE][-+]?[0-9]+)?";

/// Units of one dimension, as a regular expression. parseMeasure() knows the same ones; a test compares the two.
struct Symbols
{
    Dimension dimension;
    std::string_view pattern;
};

#define PREFIX "[pnu\u00B5\u03BCmcdkMG]?"
constexpr std::array<Symbols, 9> symbols { {
    { { 1, 0, 0 }, PREFIX "m" },
    { { 0, 1, 0 }, PREFIX "g" },
    { { 0, 0, 1 }, PREFIX "s" },
    { { 1, 1, -2 }, PREFIX "N" },
    { { 2, 1, -2 }, PREFIX "J" },
    { { 2, 1, -3 }, PREFIX "W" },
    { { -1, 1, -2 }, PREFIX "Pa" },
    { { 0, 0, -1 }, PREFIX "Hz" },
    { {}, "(?:" PREFIX "rad|deg|%|1)" },
} };
#undef PREFIX

Dimension power (Dimension d, int p) noexcept
{
    return { exponent (d.m * p), exponent (d.kg * p), exponent (d.s * p) };
}

/// A unit to some power, alone or after another: "m2", "/m2", "m-2".
std::string factor (std::string_view unit, int p, bool is_first)
{
    const auto size = std::abs (p);
    const auto raised = std::string (unit) + (size == 1 ? "" : "\\^?" + std::to_string (size));
    const std::string times = is_first ? "" : "(?: *\\* *| +)";
    if (p > 0) return times + raised;
    return (is_first ? "(?:1? */ *" : "(?: */ *") + raised + "|" + times + std::string (unit) + "\\^?-" + std::to_string (size) + ")";
}

/// The products of up to two units that have a dimension.
std::string products (Dimension wanted)
{
    constexpr int powers[] { 1, -1, 2, -2 };
    const auto has = [] (const Symbols& s, int p) { return std::abs (p) == 1 || ! (s.dimension == Dimension {}); };
    std::string all;
    const auto add = [&all] (const std::string& one) { all += (all.empty() ? "" : "|") + one; };
    for (const auto& a : symbols)
        for (const int p : powers)
        {
            if (! has (a, p)) continue;
            const auto first = power (a.dimension, p);
            if (first == wanted) add (factor (a.pattern, p, true));
            std::string second;
            for (const auto& b : symbols)
                for (const int q : powers)
                    if (has (b, q) && first * power (b.dimension, q) == wanted) second += (second.empty() ? "" : "|") + factor (b.pattern, q, false);
            if (! second.empty()) add (factor (a.pattern, p, true) + "(?:" + second + ")");
        }
    return all;
}

/// Products of at least this many units.
std::string anyProduct (int least)
{
    std::string unit;
    for (const auto& s : symbols)
        unit += (unit.empty() ? "(?:" : "|") + std::string (s.pattern);
    const auto raised = unit + ")(?:\\^?-?[0-9]+)?";
    return "(?:1? */ *)?" + raised + "(?:(?: *[*/] *| +)" + raised + "){" + std::to_string (least - 1) + ",}";
}

/// Products that have a unit to any other power than products() checks.
std::string unusualPower() { return "(?=.*[a-z%]\\^?-?(?:[013-9]|[12][0-9]))" + anyProduct (1); }

/// "N_per_m" for N/m; "1" without a dimension.
std::string nameOf (Dimension d)
{
    std::string name;
    for (const char c : symbolOf (d))
        name += c == '/' ? "_per_" : c == '*' ? "_"
                                              : std::string (1, c);
    return name;
}

std::string definitionOf (const Unit* unit) { return unit == nullptr ? "any_quantity" : "in_" + nameOf (unit->dimension); }
}   // namespace

Json Quantities::of (const Unit* unit, const Interval& hard)
{
    if (unit != nullptr) used.emplace (definitionOf (unit), *unit);
    Json schema = reference (definitionOf (unit));
    if (hard.min > -inf) schema["minimum"] = hard.min;
    if (hard.max < inf) schema["maximum"] = hard.max;
    if (hard.min >= 0.0) schema["not"] = { { "type", "string" }, { "pattern", "^\\s*-[0.]*[1-9]" } };
    return schema;
}

void Quantities::define (Json& definitions) const
{
    const auto add = [&] (const std::string& name, const std::string& units, const std::string& meaning) {
        definitions[name] = { { "type", { "number", "string" } },
                              { "pattern", "^\\s*" + number + " *(?:" + units + ") *$" },
                              { "patternErrorMessage", meaning },
                              { "description", meaning } };
    };
    add ("any_quantity", "|" + anyProduct (1), "A number, or a string with a unit, such as \"60 mN\" or \"1200 1/m\".");
    for (const auto& [name, unit] : used)
    {
        const auto symbol = symbolOf (unit.dimension);
        const bool is_plain = unit.dimension == Dimension {};
        add (name, (is_plain ? "|" : "") + products (unit.dimension) + "|" + anyProduct (3) + "|" + unusualPower(),
             is_plain ? "A number, or a string such as \"5 %\" or \"30 deg\"."
                      : "A number in " + symbol + ", or a string with such a unit, as in \"1 " + symbol + "\".");
    }
}

}   // namespace tactus::schema
