// SPDX-License-Identifier: MIT
#include "turn.hpp"

#include "file/json_text.hpp"
#include "in_quotes.hpp"
#include "near_miss.hpp"
#include "plan/directory.hpp"
#include "plan/values.hpp"
#include "refused.hpp"

namespace tactus
{

namespace
{
using Turns = std::vector<std::pair<plan::ParamRef, double>>;

std::variant<double, Message> read (const Json& value, const PortSheet& sheet, const std::string& name)
{
    if (! sheet.choices.empty())
    {
        const std::vector<std::string> names (sheet.choices.begin(), sheet.choices.end());
        const auto at = value.is_string() ? std::ranges::find (names, value.get_ref<const std::string&>()) : names.end();
        if (at != names.end()) return static_cast<double> (at - names.begin());
        return refused ("param/unknown_choice", inQuotes (name) + " cannot be " + plan::shown (value) + (value.is_string() ? didYouMean (value.get<std::string>(), names) : ""), "one of: " + plan::listed (names));
    }
    const auto number = plan::readNumber (value);
    if (const auto* problem = std::get_if<std::string> (&number)) return refused ("param/value", inQuotes (name) + ": " + *problem, "give a plain number in SI, or text with a unit");
    const auto& n = std::get<plan::Number> (number);
    if (n.dimension && sheet.unit.kind == UnitRule::Kind::fixed && (*n.dimension != sheet.unit.unit.dimension || plan::miscounts (n, sheet.unit)))
        return refused ("param/unit", inQuotes (name) + " is in " + std::string (sheet.unit.unit.symbol) + ", not in what " + plan::shown (value) + " is in", "give it in " + std::string (sheet.unit.unit.symbol));
    if (! sheet.limits.hard.contains (n.value)) return refused ("param/out_of_range", inQuotes (name) + " cannot be " + plan::shown (value), "it must be " + plan::rangeText (sheet.limits.hard));
    return n.value;
}

/// The point `amount` of the way from low to high; both are lists of the same length, or neither is.
std::optional<Message> add (Engine& engine, const std::string& name, const Json& low, const Json& high, double amount, Turns& turns)
{
    if (low.is_array())
    {
        const bool vector = low.size() == 3 && std::holds_alternative<plan::ParamRef> (engine.param (name + ".x"));
        for (std::size_t i = 0; i < low.size(); ++i)
            if (auto message = add (engine, name + (vector ? std::string (".") + "xyz"[i] : "[" + std::to_string (i) + "]"), low[i], high[i], amount, turns)) return message;
        return std::nullopt;
    }
    auto found = engine.params (name);
    if (auto* message = std::get_if<Message> (&found)) return std::move (*message);
    for (auto& param : std::get<std::vector<plan::ParamRef>> (found))
    {
        double ends[2];
        for (auto [end, json] : { std::pair { &ends[0], &low }, { &ends[1], &high } })
        {
            auto number = read (*json, *param.sheet, name);
            if (auto* message = std::get_if<Message> (&number)) return std::move (*message);
            *end = std::get<double> (number);
        }
        turns.emplace_back (std::move (param), amount == 0.0 ? ends[0] : ends[0] + amount * (ends[1] - ends[0]));
    }
    return std::nullopt;
}

void carryOut (Engine& engine, const Turns& turns)
{
    for (const auto& [param, number] : turns)
        engine.set (param, number);
}
}   // namespace

Json readValue (const std::string& text)
{
    const auto json = readJson (text).root;   // which does not recurse, whatever somebody types
    return json.is_number() || json.is_array() ? json : Json (text);
}

std::optional<Message> turnParam (Engine& engine, const std::string& name, const Json& value)
{
    Turns turns;
    if (auto message = add (engine, name, value, value, 0.0, turns)) return message;
    carryOut (engine, turns);
    return std::nullopt;
}

std::optional<Message> turnControl (Engine& engine, const graph::Graph& graph, const std::string& id, double value)
{
    const auto control = std::ranges::find (graph.controls, id, &graph::Control::id);
    if (control == graph.controls.end())
    {
        std::vector<std::string> names;
        for (const auto& c : graph.controls)
            names.push_back (c.id);
        return refused ("control/unknown", "there is no control " + inQuotes (id) + didYouMean (id, names), "controls here: " + plan::listed (names) + "; a parameter is NODE.PARAM");
    }
    if (! (value >= 0.0 && value <= 1.0)) return refused ("control/value", "the control " + inQuotes (id) + " is out of its range", "give a number from 0 to 1");

    Turns turns;
    for (const auto& target : control->to)
        if (auto message = add (engine, target.path, target.low, target.high, value, turns)) return message;
    carryOut (engine, turns);
    return std::nullopt;
}

std::optional<Message> strike (Engine& engine, const std::string& name, double speed)
{
    if (! (speed > 0.0 && speed <= fastest_hit)) return refused ("hit/value", "a hit on " + inQuotes (name) + " is out of range", "give a speed in m/s: more than 0, at most " + plan::shown (Json (fastest_hit)));
    auto found = engine.hits (name);
    if (auto* message = std::get_if<Message> (&found)) return std::move (*message);
    for (const auto& hit : std::get<std::vector<plan::HitRef>> (found))
        engine.strike (hit, speed);
    return std::nullopt;
}

}   // namespace tactus
