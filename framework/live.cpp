// SPDX-License-Identifier: MIT
#include "live.hpp"

#include "in_quotes.hpp"
#include "near_miss.hpp"
#include "plan/directory.hpp"
#include "plan/values.hpp"

namespace tactus
{

namespace
{
Message refused (std::string id, std::string text, std::string remedy)
{
    Message m;
    m.id = std::move (id);
    m.text = std::move (text);
    m.remedy = std::move (remedy);
    return m;
}

std::variant<double, Message> read (const Json& value, const PortSheet& sheet, std::string_view name)
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
    if (n.dimension && sheet.unit.kind == UnitRule::Kind::fixed && *n.dimension != sheet.unit.unit.dimension)
        return refused ("param/unit", inQuotes (name) + " is in " + std::string (sheet.unit.unit.symbol) + ", not in what " + plan::shown (value) + " is in", "give it in " + std::string (sheet.unit.unit.symbol));
    if (! sheet.limits.hard.contains (n.value)) return refused ("param/out_of_range", inQuotes (name) + " cannot be " + plan::shown (value), "it must be " + plan::rangeText (sheet.limits.hard));
    return n.value;
}
}   // namespace

Live::Live (graph::Graph g, const Catalogue& c, CompileOptions o, std::shared_ptr<Plan> first) : edits (std::move (g)), catalogue (c), options (std::move (o)), running (std::move (first)), first_rate_hz (edits.graph().rate_hz)
{
    options.rate_hz = running.newest().rate_hz;   // devices and guards hold on to it
}

Messages Live::perform (graph::Command command, graph::Step step)
{
    if (auto refusal = edits.perform (std::move (command), step)) return { std::move (*refusal) };
    return compileAndSubmit();
}

Messages Live::undo() { return edits.undo() ? compileAndSubmit() : Messages {}; }

Messages Live::redo() { return edits.redo() ? compileAndSubmit() : Messages {}; }

Messages Live::compileAndSubmit()
{
    auto waiting = running.withdraw();
    options.before = &running.newest();
    auto [plan, messages] = compile (edits.graph(), catalogue, options);
    running.submit (plan ? std::move (plan) : std::move (waiting));
    if (edits.graph().rate_hz != first_rate_hz)
        messages.push_back ({ Message::Severity::warning, "live/rate", "/rate_hz", "the graph's rate was changed, and devices and guards run at another already", "start anew to run at it" });
    return std::move (messages);
}

std::optional<Message> Live::set (std::string_view name, const Json& value)
{
    std::vector<std::pair<plan::ParamRef, double>> turns;   // all of them, or none
    const auto add = [&] (const std::string& one, const Json& to) -> std::optional<Message>
    {
        auto found = running.param (one);
        if (auto* message = std::get_if<Message> (&found)) return std::move (*message);
        auto& param = std::get<plan::ParamRef> (found);
        auto number = read (to, *param.sheet, one);
        if (auto* message = std::get_if<Message> (&number)) return std::move (*message);
        turns.emplace_back (std::move (param), std::get<double> (number));
        return std::nullopt;
    };

    if (value.is_array())
    {
        const bool vector = value.size() == 3 && std::holds_alternative<plan::ParamRef> (running.param (std::string (name) + ".x"));
        for (std::size_t i = 0; i < value.size(); ++i)
            if (auto message = add (std::string (name) + (vector ? std::string (".") + "xyz"[i] : "[" + std::to_string (i) + "]"), value[i])) return message;
    }
    else if (auto message = add (std::string (name), value))
        return message;

    for (const auto& [param, number] : turns)
        running.set (param, number);
    return std::nullopt;
}

}   // namespace tactus
