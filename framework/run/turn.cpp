// SPDX-License-Identifier: MIT
#include "turn.hpp"

#include <tactus/plan/flat/directory.hpp>
#include <tactus/plan/values.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/quote.hpp>

namespace tactus
{

namespace
{
using Turns = std::vector<std::pair<plan::ParamRef, double>>;

Result<double> read (const Json& value, const PortSheet& sheet, const std::string& name)
{
    if (! sheet.choices.empty())
    {
        const std::vector<std::string> names (sheet.choices.begin(), sheet.choices.end());
        const auto at = value.is_string() ? std::ranges::find (names, value.asString()) : names.end();
        if (at != names.end()) return static_cast<double> (at - names.begin());
        return Message::error ("param/unknown_choice", {},
                               quote (name) + " cannot be " + plan::shown (value) + (value.is_string() ? didYouMean (value.get<std::string>(), names) : ""),
                               "use one of: " + plan::listed (names));
    }
    const auto number = plan::readNumber (value);
    if (! number) return Message::error ("param/value", {}, quote (name) + ": " + number.error().text,
                                         "give a plain number in SI units, or text with a unit such as \"2 N/mm\"");
    const auto& n = *number;
    const std::string unit (sheet.unit.unit.symbol);
    const bool has_unit = ! unit.empty() && unit != "1";
    if (n.dimension && sheet.unit.kind == UnitRule::Kind::fixed && (*n.dimension != sheet.unit.unit.dimension || plan::miscounts (n, sheet.unit)))
        return Message::error ("param/unit", {},
                               quote (name) + (has_unit ? " is in " + unit : " has no unit") + ", but " + plan::shown (value) + " is in another unit",
                               has_unit ? "give it in " + unit : "give a number without a unit");
    if (! sheet.limits.hard.contains (n.value))
        return Message::error ("param/out_of_range", {}, quote (name) + " cannot be " + plan::shown (value),
                               "it must be " + plan::rangeText (sheet.limits.hard));
    return n.value;
}

/// Adds turns that move a parameter to the point at `amount` (0…1) between low and high. Either both are lists of the same length, or neither is a list.
Result<> add (Engine& engine, const std::string& name, const Json& low, const Json& high, double amount, Turns& turns)
{
    if (low.is_array())
    {
        if (low.empty()) return Message::error ("param/shape", {}, quote (name) + " is set to an empty list", "give one number for each component");
        const bool vector = low.size() == 3 && engine.param (name + ".x").has_value();
        for (std::size_t i = 0; i < low.size(); ++i)
        {
            const auto part = vector ? std::string (".") + "xyz"[i] : "[" + std::to_string (i) + "]";
            if (auto added = add (engine, name + part, low[i], high[i], amount, turns); ! added) return added;
        }
        return {};
    }
    auto found = engine.params (name);
    if (! found) return std::move (found).error();
    for (auto& param : *found)
    {
        double ends[2];
        for (auto [end, json] : { std::pair { &ends[0], &low }, { &ends[1], &high } })
        {
            auto number = read (*json, *param.sheet, name);
            if (! number) return std::move (number).error();
            *end = *number;
        }
        turns.emplace_back (std::move (param), amount == 0.0 ? ends[0] : ends[0] + amount * (ends[1] - ends[0]));
    }
    return {};
}

void carryOut (Engine& engine, const Turns& turns)
{
    for (const auto& [param, number] : turns)
        engine.set (param, number);
}
}   // namespace

Json readValue (const std::string& text)
{
    const auto json = readJson (text).root;   // does not recurse, so any text is safe
    return json.is_number() || json.is_array() || json.is_string() ? json : Json (text);
}

Result<plan::Override> readOverride (const std::string& text)
{
    const auto equals = text.find ('=');
    if (equals == std::string::npos || equals == 0)
        return Message::error ("param/no_value", {}, "'" + text + "' is not NODE.PARAM=VALUE", "write, for example, drag.mu=0.3 or board.stiffness=\"2 N/mm\"");
    return plan::Override { text.substr (0, equals), readValue (text.substr (equals + 1)) };
}

Result<> turnParam (Engine& engine, const std::string& name, const Json& value)
{
    Turns turns;
    if (auto added = add (engine, name, value, value, 0.0, turns); ! added) return added;
    carryOut (engine, turns);
    return {};
}

Result<const graph::Control*> findControl (const graph::Graph& graph, const std::string& id)
{
    const auto control = std::ranges::find (graph.controls, id, &graph::Control::id);
    if (control != graph.controls.end()) return &*control;
    std::vector<std::string> names;
    for (const auto& c : graph.controls)
        names.push_back (c.id);
    return Message::error ("control/unknown", {}, "there is no control " + quote (id) + didYouMean (id, names),
                           "the controls of this graph: " + plan::listed (names) + "; to set a parameter, write NODE.PARAM");
}

Message beyondControl (const std::string& id)
{
    return Message::error ("control/value", {}, "the value for the control " + quote (id) + " is out of range", "give a number from 0 to 1");
}

Result<> turnControl (Engine& engine, const graph::Graph& graph, const std::string& id, double value)
{
    const auto found = findControl (graph, id);
    if (! found) return found.error();
    const auto* control = *found;
    if (! (value >= 0.0 && value <= 1.0)) return beyondControl (id);

    Turns turns;
    for (const auto& target : control->to)
        if (auto added = add (engine, target.path, target.low, target.high, value, turns); ! added) return added;
    carryOut (engine, turns);
    return {};
}

Result<> strike (Engine& engine, const std::string& name, double speed)
{
    if (! (speed > 0.0 && speed <= fastest_hit))
        return Message::error ("hit/value", {}, "the speed of a hit on " + quote (name) + " is out of range",
                               "give a speed in m/s: more than 0, at most " + plan::shown (Json (fastest_hit)));
    auto found = engine.hits (name);
    if (! found) return std::move (found).error();
    for (const auto& hit : *found)
        engine.strike (hit, speed);
    return {};
}

}   // namespace tactus
