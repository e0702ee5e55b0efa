// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_server.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/graph/param_edit.hpp>
#include <tactus/text/message.hpp>

namespace tactus::host
{

namespace
{
constexpr auto pause_between_steps = std::chrono::seconds (1);
}

OscServer::OscServer (std::unique_ptr<OscPort> port, Playback& p, Document& d, std::function<bool()> asking)
    : osc (std::move (port)), playback (p), document (d), is_asking (std::move (asking))
{
}

void OscServer::poll (RemoteControl::Clock::time_point now)
{
    control.poll (now);
    performEdits (now);
    checkProbes();
    sendValues();
}

Result<> OscServer::setParam (const std::string& name, const Json& value)
{
    if (auto turned = live_run.turn (name, value); ! turned) return turned;
    const bool can_be_stored = graph::paramEdit (document.graph(), name, value).has_value();   // false for a part of a value that the file stores as a whole
    if (can_be_stored) new_params[name] = value;
    return {};
}

Result<> OscServer::rearm (std::chrono::steady_clock::time_point)
{
    return Message::error ("osc/rearm", {}, "the window accepts no rearm over OSC", "press REARM in the window");
}

Result<> OscServer::turnControl (const std::string& id, double value)
{
    if (auto turned = live_run.turnControl (id, value); ! turned) return turned;
    new_controls[id] = value;
    return {};
}

/// Turns the values set since the last call into an edit.
void OscServer::performEdits (RemoteControl::Clock::time_point now)
{
    if (new_params.empty() && new_controls.empty()) return;
    graph::Batch batch { NEEDS_TRANS ("set by OSC"), {} };
    for (const auto& [name, value] : new_params)
        if (auto edit = graph::paramEdit (document.graph(), name, value)) batch.commands.push_back (*std::move (edit));
    for (const auto& [id, value] : new_controls)
        if (const auto found = std::ranges::find (document.graph().controls, id, &graph::Control::id); found != document.graph().controls.end())
        {
            auto to = *found;
            to.value = value;
            batch.commands.push_back (graph::ChangeControl { id, std::move (to) });
        }
    new_params.clear();
    new_controls.clear();
    if (batch.commands.empty()) return;
    const bool goes_on = document.history().position() == edited_position && now < edited_at + pause_between_steps;
    document.perform (std::move (batch), goes_on ? graph::Step::joined : graph::Step::own);
    edited_position = document.history().position();
    edited_at = now;
}

Result<std::vector<std::string>> OscServer::probe (const std::vector<std::string>& ports)
{
    if (! ports.empty() && ! live_run.isRunning())
        return Message::error ("run/stopped", {}, "nothing is running in the window", "press START in the window, or send /tactus/start");
    const auto before = probed.wanted();
    probed.want (ports);
    std::vector<std::string> names;
    for (const auto& port : ports)
    {
        const auto found = probed.of (port);
        if (found.empty())
        {
            probed.want (before);
            return Message::error ("port/unknown_node", {}, "there is no port '" + port + "'", "use a name such as drag.force");
        }
        for (const auto& trace : found)
            if (std::ranges::count (names, trace->name()) == 0) names.push_back (trace->name());
    }
    if (const auto& left = live_run.traces().leftOut(); ! left.empty())
    {
        probed.want (before);
        return Message::error ("probe/too_many", {}, "cannot probe '" + left.front() + "': too many ports are already being probed",
                               "close a scope, or wait until other probes end");
    }
    if (components.empty() && ! names.empty()) sent = probed.of (names.front()).front()->end();
    components = names;
    return names;
}

Result<std::vector<std::string>> OscServer::capture (const std::string& port, const std::string& watched, const Trigger& trigger)
{
    auto names = live_run.capture (port, watched, trigger);
    captures = names.has_value();
    return names;
}

void OscServer::endCapture()
{
    live_run.endCapture();
    captures = false;
}

/// Tells the remote control if an edit or a new run has removed a probed port or ended a capture.
void OscServer::checkProbes()
{
    const bool lost = std::ranges::any_of (components, [&] (const std::string& c) { return probed.of (c).empty(); });
    if (lost || (captures && ! live_run.isCapturing())) control.graphChanged();
}

/// Sends the ticks that are complete for all components.
void OscServer::sendValues()
{
    if (components.empty()) return;
    std::vector<std::shared_ptr<const Trace>> traces;
    for (const auto& c : components)
        traces.push_back (probed.of (c).front());
    std::uint64_t begin = 0, end = traces.front()->end();
    for (const auto& t : traces)
    {
        begin = std::max (begin, t->begin());
        end = std::min (end, t->end());
    }
    if (sent > end) sent = begin;   // a new run
    std::vector<double> values (traces.size());
    for (sent = std::max (sent, begin); sent < end; ++sent)
    {
        std::ranges::transform (traces, values.begin(), [&] (const auto& t) { return t->at (sent); });
        control.values (sent, values);
    }
}

OscServer::Status OscServer::status()
{
    Status now { .name = document.graph().name, .rate_hz = live_run.rate() };
    if (const auto s = live_run.status())
    {
        now.time_s = now.rate_hz > 0.0 ? static_cast<double> (s->ticks) / now.rate_hz : 0.0;
        now.force = s->force;
        now.peak = s->peak;
        now.ticks = s->ticks;
        now.misses = s->misses;
    }
    return now;
}

std::vector<OscServer::Role> OscServer::roles()
{
    const auto s = live_run.status();
    return s ? rolesOf (*s) : std::vector<Role> {};
}

Result<> OscServer::transport (const Transport& to)
{
    const auto& path = live_run.transport();
    if (path == nullptr) return Message::error ("osc/transport", {}, "the hand follows no gesture or recording", "choose one in the Hand panel of the window");
    if (to.plays) path->play (*to.plays);
    if (to.seek) path->seek (*to.seek);
    if (to.speed) path->setSpeed (std::clamp (*to.speed, TransportPath::least_speed, TransportPath::most_speed));
    return {};
}

/// Only a person in the window ends a latched stop or a stop of a person by a start, or lets a start loosen limits.
Result<> OscServer::start()
{
    if (live_run.isHeld() || live_run.isStoppedForGood() || ! live_run.canRearm())
        return Message::error ("osc/stopped", {}, "the forces are stopped until someone rearms", "press REARM or START in the window");
    if (auto may = playback.stopSwitch().mayStart(); ! may) return may;
    if (is_asking && is_asking()) return Message::error ("osc/question", {}, "the window shows a question", "answer the question in the window first");
    playback.startAgain (By::program);
    const auto& messages = live_run.messages();
    const auto error = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    return error == messages.end() ? Result<> {} : *error;
}

}   // namespace tactus::host
