// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_reach.hpp"

#include <framework/graph/param_edit.hpp>
#include <framework/refused.hpp>

namespace tactus::host
{

namespace
{
constexpr auto pause_between_steps = std::chrono::seconds (1);
}

OscReach::OscReach (std::unique_ptr<OscPort> port, Performance& p, Document& d, Switches s) : osc (std::move (port)), performance (p), document (d), switches (std::move (s)) {}

void OscReach::attend (RemoteControl::Clock::time_point now)
{
    control.attend (now);
    keep (now);
    lookAgain();
    sendValues();
}

std::optional<Message> OscReach::setParam (const std::string& name, const Json& value)
{
    if (auto problem = performance.turn (name, value)) return problem;
    const bool is_part = std::holds_alternative<Message> (graph::paramEdit (document.graph(), name, value));   // of a value that is kept as a whole
    if (! is_part) turned[name] = value;
    return std::nullopt;
}

std::optional<Message> OscReach::turnControl (const std::string& id, double value)
{
    if (auto problem = performance.turnControl (id, value)) return problem;
    moved[id] = value;
    return std::nullopt;
}

/// The edits of what was turned since the last time.
void OscReach::keep (RemoteControl::Clock::time_point now)
{
    if (turned.empty() && moved.empty()) return;
    graph::Batch batch { "turn by OSC", {} };
    for (const auto& [name, value] : turned)
        if (auto edit = graph::paramEdit (document.graph(), name, value); auto* command = std::get_if<graph::Command> (&edit)) batch.commands.push_back (std::move (*command));
    for (const auto& [id, value] : moved)
        if (const auto found = std::ranges::find (document.graph().controls, id, &graph::Control::id); found != document.graph().controls.end())
        {
            auto to = *found;
            to.value = value;
            batch.commands.push_back (graph::ChangeControl { id, std::move (to) });
        }
    turned.clear();
    moved.clear();
    if (batch.commands.empty()) return;
    const bool goes_on = document.history().position() == kept_as && now < kept_at + pause_between_steps;
    document.perform (std::move (batch), goes_on ? graph::Step::joined : graph::Step::own);
    kept_as = document.history().position();
    kept_at = now;
}

std::variant<std::vector<std::string>, Message> OscReach::probe (const std::vector<std::string>& ports)
{
    if (! ports.empty() && ! performance.isRunning()) return refused ("run/stopped", "nothing runs in the window", "press START there, or send /tactus/start");
    const auto before = looked_at.wanted();
    looked_at.want (ports);
    std::vector<std::string> names;
    for (const auto& port : ports)
    {
        const auto found = looked_at.of (port);
        if (found.empty())
        {
            looked_at.want (before);
            return refused ("port/unknown_node", "there is no port '" + port + "'", "name one as in drag.force");
        }
        for (const auto& trace : found)
            if (std::ranges::count (names, trace->name()) == 0) names.push_back (trace->name());
    }
    if (const auto& left = performance.traces().leftOut(); ! left.empty())
    {
        looked_at.want (before);
        return refused ("probe/too_many", "with what the scopes show there is no room for '" + left.front() + "'", "close a scope, or wait until other probes are over");
    }
    if (components.empty() && ! names.empty()) sent = looked_at.of (names.front()).front()->end();
    components = names;
    return names;
}

std::variant<std::vector<std::string>, Message> OscReach::capture (const std::string& port, const std::string& watched, const Trigger& trigger)
{
    auto names = performance.capture (port, watched, trigger);
    captures = std::holds_alternative<std::vector<std::string>> (names);
    return names;
}

void OscReach::endCapture()
{
    performance.endCapture();
    captures = false;
}

/// After an edit that took away what is looked at, or another run.
void OscReach::lookAgain()
{
    const bool lost = std::ranges::any_of (components, [&] (const std::string& c)
                                           { return looked_at.of (c).empty(); });
    if (lost || (captures && ! performance.isCapturing())) control.graphChanged();
}

/// What all components have by now.
void OscReach::sendValues()
{
    if (components.empty()) return;
    std::vector<std::shared_ptr<const Trace>> traces;
    for (const auto& c : components)
        traces.push_back (looked_at.of (c).front());
    std::uint64_t begin = 0, end = traces.front()->end();
    for (const auto& t : traces)
    {
        begin = std::max (begin, t->begin());
        end = std::min (end, t->end());
    }
    if (sent > end) sent = begin;   // a run that began anew
    std::vector<double> values (traces.size());
    for (sent = std::max (sent, begin); sent < end; ++sent)
    {
        std::ranges::transform (traces, values.begin(), [&] (const auto& t)
                                { return t->at (sent); });
        control.values (sent, values);
    }
}

OscReach::Status OscReach::status()
{
    Status now { .name = document.graph().name, .rate_hz = performance.rate() };
    if (const auto s = performance.status())
    {
        now.time_s = now.rate_hz > 0.0 ? static_cast<double> (s->ticks) / now.rate_hz : 0.0;
        now.force = s->force;
        now.peak = s->peak;
        now.ticks = s->ticks;
        now.misses = s->misses;
    }
    return now;
}

std::vector<OscReach::Role> OscReach::roles()
{
    const auto s = performance.status();
    return s ? rolesOf (*s) : std::vector<Role> {};
}

std::optional<Message> OscReach::transport (const Transport& to)
{
    const auto& path = performance.transport();
    if (path == nullptr) return refused ("osc/transport", "the hand follows no gesture and no recording", "choose one in the window, at The hand");
    if (to.plays) path->play (*to.plays);
    if (to.seek) path->seek (*to.seek);
    if (to.speed) path->setSpeed (std::clamp (*to.speed, TransportPath::least_speed, TransportPath::most_speed));
    return std::nullopt;
}

std::optional<Message> OscReach::start()
{
    switches.start();
    const auto& said = performance.messages();
    const auto error = std::ranges::find (said, Message::Severity::error, &Message::severity);
    return error == said.end() ? std::nullopt : std::optional (*error);
}

}   // namespace tactus::host
