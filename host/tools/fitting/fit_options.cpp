// SPDX-License-Identifier: MIT
#include "fit_options.hpp"

#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::host
{

namespace
{
constexpr double tiny = std::numeric_limits<double>::min(), huge = std::numeric_limits<double>::max();   // any number above 0; any number

Message wrong (const std::string& key, const std::string& text, const std::string& remedy) { return Message::error ("fit/option", key, text, remedy); }

std::string unitText (const FitOption& option) { return *option.unit == '\0' ? "" : std::string (" ") + option.unit; }

/// A number in SI, or a text with a unit of the same dimension.
Result<double> amountOf (const FitOption& option, const Json& value)
{
    double number = std::nan ("");
    if (value.is_number()) number = value.get<double>();
    if (value.is_string() && *option.unit != '\0')
        if (const auto amount = parseMeasure (value.asString()), unit = parseMeasure (std::string ("1 ") + option.unit);
            amount && amount->dimension == unit->dimension)
            number = amount->value;
    if (! (number >= option.least && number <= option.most) || (option.is_whole && number != std::floor (number)))
        return wrong (option.name, value.dump() + " does not fit",
                      option.most < huge ? "give a " + std::string (option.is_whole ? "whole " : "") + "number from " + numberText (option.least) + " to "
                                               + numberText (option.most) + unitText (option)
                      : option.least > 0.0 ? "give a number above 0, in" + unitText (option)
                                           : "give a number in" + unitText (option));
    return number;
}

/// The roles of columns, and what is said of each.
Result<> readRoles (FitSettings& to, FitKind kind, const std::string& key, const Json& given)
{
    if (! given.is_object()) return wrong (key, "this is not a value for each role", "give an object such as {\"force\": …}");
    const auto& columns = infoOf (kind).columns;
    for (const auto& [role, value] : given.items())
    {
        const auto column = std::ranges::find (columns, role, &FitColumn::role);
        if (column == columns.end())
        {
            std::vector<std::string> roles;
            for (const auto& c : columns)
                roles.push_back (c.role);
            return wrong (key, "a " + infoOf (kind).id + " has no column for " + quote (role), suggestion (role, roles));
        }
        if (! value.is_string()) return wrong (key + "/" + role, value.dump() + " is not a text", "give a text");
        const auto& text = value.asString();
        if (key == "columns")
            to.columns.names[role] = text;
        else if (key == "units")
        {
            const auto factor = column->unit.empty() ? std::nullopt : factorOf (text, column->unit);
            if (! factor)
                return wrong ("units/" + role, quote (text) + " does not fit",
                              column->unit.empty() ? "leave it out: the column may have any unit"
                                                   : "give what 1 in the column means, such as \"1 " + column->unit + "\"");
            to.columns.units[role] = *factor;
        }
        else if (text == "+" || text == "-")
            to.columns.turned[role] = text == "-";
        else
            return wrong ("signs/" + role, quote (text) + " is no sign", "give \"+\" or \"-\"");
    }
    return {};
}
}   // namespace

const std::vector<FitOption>& fitOptions()
{
    using K = FitKind;
    using S = FitSettings;
    static const std::vector<FitOption> all {
        { K::friction, "load", "N", tiny, huge, false, [] (S& s, double v) { s.load = v; } },
        { K::modes, "from", "s", -huge, huge, false, [] (S& s, double v) { s.from = v; } },
        { K::modes, "to", "s", -huge, huge, false, [] (S& s, double v) { s.to = v; } },
        { K::modes, "blow", "s", -huge, huge, false, [] (S& s, double v) { s.blow = v; } },
        { K::modes, "mass", "kg", tiny, huge, false, [] (S& s, double v) { s.mass = v; } },
        { K::modes, "speed", "m/s", tiny, huge, false, [] (S& s, double v) { s.speed = v; } },
        { K::modes, "most", "", 1, 40, true, [] (S& s, double v) { s.most = static_cast<int> (v); } },
        { K::modes, "rate", "Hz", 0.01, 1e7, false, [] (S& s, double v) { s.rate = v; } },
        { K::texture, "speed", "m/s", tiny, huge, false, [] (S& s, double v) { s.speed = v; } },
        { K::texture, "force", "N", tiny, huge, false, [] (S& s, double v) { s.force = v; } },
        { K::texture, "mass", "kg", tiny, huge, false, [] (S& s, double v) { s.mass = v; } },
        { K::texture, "most", "", 1, 200, true, [] (S& s, double v) { s.most = static_cast<int> (v); } },
        { K::texture, "rate", "Hz", 0.01, 1e7, false, [] (S& s, double v) { s.rate = v; } },
        { K::grating, "load", "N", tiny, huge, false, [] (S& s, double v) { s.load = v; } },
        { K::grating, "most", "", 1, 32, true, [] (S& s, double v) { s.most = static_cast<int> (v); } },
        { K::blade, "width", "m", tiny, huge, false, [] (S& s, double v) { s.width = v; } },
        { K::blade, "touch", "m", -huge, huge, false, [] (S& s, double v) { s.touch = v; } },
        { K::curve, "touch", "m", -huge, huge, false, [] (S& s, double v) { s.touch = v; } },
        { K::curve, "points", "", 2, 1000, true, [] (S& s, double v) { s.points = static_cast<int> (v); } },
        { K::curve, "mu", "", 0.0, 10.0, false, [] (S& s, double v) { s.mu = v; } },
        { K::curve, "ratio", "", 1e-6, 1e3, false, [] (S& s, double v) { s.ratio = v; } },
        { K::key_switch, "tolerance", "N", tiny, huge, false, [] (S& s, double v) { s.tolerance = v; } },
        { K::key_switch, "stiffness", "N/m", tiny, huge, false, [] (S& s, double v) { s.stiffness = v; } },
        { K::key_switch, "backlash", "m", tiny, huge, false, [] (S& s, double v) { s.backlash = v; } },
        { K::shock, "mass", "kg", tiny, huge, false, [] (S& s, double v) { s.mass = v; } },
        { K::shock, "rate", "Hz", 0.01, 1e7, false, [] (S& s, double v) { s.rate = v; } },
    };
    return all;
}

const FitOption* findFitOption (FitKind kind, std::string_view name)
{
    const auto found = std::ranges::find_if (fitOptions(), [&] (const FitOption& o) { return o.kind == kind && o.name == name; });
    return found == fitOptions().end() ? nullptr : &*found;
}

Result<FitSettings> readFitSettings (FitKind kind, const Json& given)
{
    FitSettings settings;
    for (const auto& [key, value] : given.items())
    {
        if (key == "columns" || key == "units" || key == "signs")
        {
            if (auto read = readRoles (settings, kind, key, value); ! read) return read.error();
            continue;
        }
        const auto* option = findFitOption (kind, key);
        if (option == nullptr)
        {
            std::vector<std::string> known { "columns", "units", "signs" };
            for (const auto& o : fitOptions())
                if (o.kind == kind) known.emplace_back (o.name);
            return wrong (key, "a fit of kind " + infoOf (kind).id + " has no such option", suggestion (key, known));
        }
        const auto amount = amountOf (*option, value);
        if (! amount) return amount.error();
        option->set (settings, *amount);
    }
    return settings;
}

}   // namespace tactus::host
