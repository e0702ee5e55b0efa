// SPDX-License-Identifier: GPL-3.0-or-later
#include "remote_control.hpp"

#include <framework/in_quotes.hpp>
#include <framework/refused.hpp>
#include <framework/turn.hpp>
#include <host/runtime/probe_ring.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
using juce::OSCArgument;
using juce::OSCMessage;

constexpr std::string_view transport_addresses = "/tactus/transport/";
constexpr std::size_t most_probes = 16;
constexpr double highest_rate = 1000.0, usual_rate = 50.0;   // Hz
constexpr double longest = 60.0, usual_length = 5.0;         // s
constexpr int usual_before = 100, usual_after = 400;         // ticks
constexpr int most_at_a_time = 512;                          // messages
constexpr double most_costs = 100, usual_costs = 10;         // nodes
constexpr int most_rows_at_a_time = 32;                      // messages with rows of a capture, so that none is lost on the way
constexpr std::size_t most_numbers = 60;                     // in such a message, since readPacket takes 64 arguments

std::string textOf (const juce::String& s) { return s.toStdString(); }

/// A number, whichever kind it came as.
std::optional<double> numberOf (const OSCArgument& a)
{
    if (a.isFloat32()) return a.getFloat32();
    if (a.isInt32()) return a.getInt32();
    return std::nullopt;
}

/// Of a value: text is read as --set reads it.
std::optional<Json> valueOf (const OSCArgument& a)
{
    if (a.isString()) return readValue (textOf (a.getString()));
    if (const auto number = numberOf (a)) return Json (*number);
    return std::nullopt;
}

bool isPort (const OSCArgument& a) { return a.isInt32() && a.getInt32() > 0 && a.getInt32() < 65536; }

/// The last argument, if it stands where a port may stand; 0: nobody is to be answered.
int answerPort (const OSCMessage& m, int place) { return m.size() == place + 1 && isPort (m[place]) ? m[place].getInt32() : 0; }

RemoteControl::Clock::duration durationOf (double seconds) { return std::chrono::duration_cast<RemoteControl::Clock::duration> (std::chrono::duration<double> (std::min (seconds, longest))); }

std::optional<Trigger::Edge> edgeOf (const OSCArgument& a)
{
    const auto name = a.isString() ? textOf (a.getString()) : std::string();
    if (name == "rising") return Trigger::Edge::rising;
    if (name == "falling") return Trigger::Edge::falling;
    if (name == "either") return Trigger::Edge::either;
    return std::nullopt;
}

Message badArguments (const std::string& remedy) { return refused ("osc/arguments", "the arguments are not what belongs here", remedy); }
}   // namespace

std::vector<Controlled::Role> rolesOf (const RunStatus& status)
{
    std::vector<Controlled::Role> roles;
    for (const auto& r : status.shown())
        roles.push_back ({ .name = std::string (r.name), .withholds = r.stop != Guard::Stop::none, .force = r.force, .torque = r.torque, .last_stop = r.latest == Guard::Stop::none ? std::string() : describe (r.latestEvent()) });
    return roles;
}

void RemoteControl::attend (Clock::time_point now)
{
    for (int i = 0; i < most_at_a_time; ++i)
        if (const auto received = port.receive())
            carryOut (received->message, received->host, now);
        else
            break;

    const auto left = std::erase_if (probes, [&] (const Probe& p)
                                     { return now >= p.end; });
    if (left > 0 && probes.empty()) look ({});

    sendCapture();
    if (capture && capture->sent == 0 && now >= capture->end)
    {
        capture.reset();
        controlled.endCapture();
    }
}

void RemoteControl::carryOut (const OSCMessage& m, const std::string& host, Clock::time_point now)
{
    const auto address = textOf (m.getAddressPattern().toString());
    const auto subject = m.size() > 0 && m[0].isString() ? textOf (m[0].getString()) : std::string();

    const auto last = [&] (int place)
    { return OscReturn { host, answerPort (m, place) }; };
    const auto at = [&] (int i)
    { return OscReturn { host, m[i].getInt32() }; };
    const auto hasPort = [&] (int i)
    { return m.size() > i && isPort (m[i]) && ! host.empty(); };

    if (address == "/tactus/param" || address == "/tactus/control")
    {
        const bool control = address == "/tactus/control";
        const auto value = m.size() >= 2 ? valueOf (m[1]) : std::nullopt;
        std::optional<Message> problem;
        if (subject.empty() || ! value || m.size() > 3)
            problem = badArguments ("a name, a value (float, int, or text with a unit), and perhaps the port for the answer");
        else if (control)
            problem = controlled.turnControl (subject, value->is_number() ? value->get<double>() : std::nan (""));
        else
            problem = controlled.setParam (subject, *value);
        answer (last (2), address, subject, problem);
    }
    else if (address == "/tactus/hit")
    {
        const auto speed = m.size() >= 2 ? numberOf (m[1]) : std::nullopt;
        const bool right = ! subject.empty() && speed && m.size() <= 3;
        answer (last (2), address, subject, right ? controlled.strike (subject, *speed) : badArguments ("an input for hits, a speed in m/s (float or int), and perhaps the port for the answer"));
    }
    else if (host.empty() && (address == "/tactus/probe" || address == "/tactus/trigger"))
        return;   // whoever gets no answers has no use for them
    else if (address == "/tactus/probe")
    {
        if (auto problem = subscribe (m, host, now); problem && hasPort (1)) answer (at (1), address, subject, problem);
    }
    else if (address == "/tactus/trigger")
    {
        if (auto problem = subscribeCapture (m, host, now); problem && hasPort (1)) answer (at (1), address, subject, problem);
    }
    else if (address == "/tactus/status" && m.size() == 1 && hasPort (0))
    {
        const auto s = controlled.status();
        const auto whole = [] (std::uint64_t n)
        { return static_cast<juce::int32> (n & 0x7fffffffu); };
        port.send (at (0), OSCMessage ("/tactus/status", juce::String::fromUTF8 (s.name.c_str()), static_cast<float> (s.rate_hz), static_cast<float> (s.time_s), static_cast<float> (s.force), static_cast<float> (s.peak), whole (s.ticks), whole (s.misses)));
    }
    else if (address == "/tactus/costs" && m.size() >= 1 && m.size() <= 2 && hasPort (0))
    {
        const auto wanted = m.size() > 1 ? numberOf (m[1]) : std::optional (usual_costs);
        if (wanted && *wanted >= 1.0)
            sendCosts (at (0), static_cast<std::size_t> (std::min (*wanted, most_costs)));
        else
            answer (at (0), address, "", badArguments ("the port for the answer, and perhaps how many nodes"));
    }
    else if (address == "/tactus/guard" && m.size() == 1 && hasPort (0))
        sendRoles (at (0));
    else if (address.starts_with (transport_addresses))
        answer (last (1), address, "", transport (address.substr (transport_addresses.size()), m));
    else if (address == "/tactus/start")
        answer (last (0), address, "", start());
    else if (address == "/tactus/rearm")
        answer (last (0), address, "", rearm());
    else if (address == "/tactus/stop" || address == "/tactus/emergency")
    {
        if (address == "/tactus/stop")
            controlled.stop();
        else
            controlled.emergencyStop();
        answer (last (0), address, "", std::nullopt);
    }
}

void RemoteControl::sendCosts (const OscReturn& to, std::size_t most)
{
    auto costs = controlled.costs();
    costs.resize (std::min (costs.size(), most));
    for (const auto& c : costs)
        port.send (to, OSCMessage ("/tactus/cost", juce::String::fromUTF8 (c.node.c_str()), juce::String::fromUTF8 (c.type.c_str()), static_cast<float> (c.mean_s), static_cast<float> (c.share)));
    answer (to, "/tactus/costs", "", std::nullopt);
}

void RemoteControl::sendRoles (const OscReturn& to)
{
    for (const auto& r : controlled.roles())
        port.send (to, OSCMessage ("/tactus/guard", juce::String::fromUTF8 (r.name.c_str()), static_cast<juce::int32> (r.withholds), static_cast<float> (r.force), static_cast<float> (r.torque), juce::String::fromUTF8 (r.last_stop.c_str())));
    answer (to, "/tactus/guard", "", std::nullopt);
}

/// Whoever has forces rise has to see that nobody can be hurt.
std::optional<Message> RemoteControl::start()
{
    if (! port.listensTo().isLoopback()) return refused ("osc/start", "other machines may send this too, and cannot see whether somebody would be hurt", "start it where the device is");
    return controlled.start();
}

std::optional<Message> RemoteControl::rearm()
{
    if (! port.listensTo().isLoopback()) return refused ("osc/rearm", "other machines may send this too, and cannot see whether somebody would be hurt", "rearm where the device is: with R in the terminal of play, with REARM in the window");
    controlled.rearm();
    return std::nullopt;
}

std::optional<Message> RemoteControl::transport (const std::string& what, const OSCMessage& m)
{
    const auto value = m.size() >= 1 && m.size() <= 2 ? numberOf (m[0]) : std::nullopt;
    if (what == "play" && value) return controlled.transport ({ .plays = *value != 0.0 });
    if (what == "seek" && value && *value >= 0.0) return controlled.transport ({ .seek = value });
    if (what == "speed" && value && *value > 0.0) return controlled.transport ({ .speed = value });
    return badArguments ("/tactus/transport/play 0 or 1, /tactus/transport/seek s, or /tactus/transport/speed factor; and perhaps the port for the answer");
}

std::optional<Message> RemoteControl::subscribe (const OSCMessage& m, const std::string& host, Clock::time_point now)
{
    const auto number = [&] (int i, double otherwise)
    { return m.size() > i ? numberOf (m[i]) : std::optional (otherwise); };
    const auto rate = number (2, usual_rate), length = number (3, usual_length);
    if (m.size() < 2 || m.size() > 4 || ! m[0].isString() || ! isPort (m[1]) || ! rate || ! length || ! (*rate > 0.0) || ! (*length > 0.0))
        return badArguments ("a port of the graph, the port for the answers, and perhaps how often (Hz) and how long (s)");

    Probe probe { .name = textOf (m[0].getString()), .to = { host, m[1].getInt32() }, .rate = std::min (*rate, highest_rate), .end = now + durationOf (*length) };
    const auto same = std::ranges::find_if (probes, [&] (const Probe& p)
                                            { return p.name == probe.name && p.to == probe.to; });
    if (same != probes.end())
    {
        same->rate = probe.rate;
        same->end = probe.end;
    }
    else
    {
        if (probes.size() >= most_probes) return refused ("probe/too_many", "there are " + std::to_string (most_probes) + " probes already", "wait until one of them is over");
        auto more = probes;
        more.push_back (probe);
        if (auto problem = look (more)) return problem;
    }

    const auto& now_probed = *std::ranges::find_if (probes, [&] (const Probe& p)
                                                    { return p.name == probe.name && p.to == probe.to; });
    OSCMessage done ("/tactus/done", juce::String ("/tactus/probe"), juce::String::fromUTF8 (probe.name.c_str()), static_cast<float> (rate_hz));
    for (const auto c : now_probed.components)
        done.addString (juce::String::fromUTF8 (components[c].c_str()));
    port.send (probe.to, done);
    return std::nullopt;
}

std::optional<Message> RemoteControl::subscribeCapture (const OSCMessage& m, const std::string& host, Clock::time_point now)
{
    const auto whole = [&] (int i, int otherwise)
    { return m.size() <= i ? otherwise : m[i].isInt32() ? m[i].getInt32()
                                                        : -1; };
    const auto number = [&] (int i, double otherwise)
    { return m.size() <= i ? otherwise : numberOf (m[i]).value_or (std::nan ("")); };
    const double level = number (3, std::nan ("")), length = number (7, usual_length);
    const auto edge = m.size() > 4 ? edgeOf (m[4]) : std::optional (Trigger::Edge::rising);
    const int before = whole (5, usual_before), after = whole (6, usual_after);
    if (m.size() < 4 || m.size() > 8 || ! m[0].isString() || ! isPort (m[1]) || ! m[2].isString() || ! std::isfinite (level) || ! edge || before < 0 || after < 0 || ! (length > 0.0))
        return badArguments ("a port of the graph, the port for the answers, the port of the graph that triggers, its level, and perhaps rising, falling or either, ticks before, ticks after, and for how long (s)");

    Capture wanted { .name = textOf (m[0].getString()), .watched = textOf (m[2].getString()), .to = { host, m[1].getInt32() }, .trigger = { level, *edge, static_cast<std::size_t> (before), static_cast<std::size_t> (after) }, .end = now + durationOf (length) };
    if (! capture) return arm (std::move (wanted));
    if (capture->to != wanted.to || capture->name != wanted.name) return refused ("probe/busy", "somebody else waits for a trigger", "wait until that is over");
    capture->end = wanted.end;
    confirmCapture();
    return std::nullopt;
}

std::optional<Message> RemoteControl::arm (Capture wanted)
{
    auto armed = controlled.capture (wanted.name, wanted.watched, wanted.trigger);
    if (auto* problem = std::get_if<Message> (&armed)) return std::move (*problem);
    wanted.components = std::move (std::get<std::vector<std::string>> (armed));
    capture = std::move (wanted);
    confirmCapture();
    return std::nullopt;
}

void RemoteControl::confirmCapture()
{
    OSCMessage done ("/tactus/done", juce::String ("/tactus/trigger"), juce::String::fromUTF8 (capture->name.c_str()), static_cast<float> (controlled.status().rate_hz));
    for (const auto& name : capture->components)
        done.addString (juce::String::fromUTF8 (name.c_str()));
    port.send (capture->to, done);
}

void RemoteControl::sendCapture()
{
    const auto* whole = capture ? controlled.captured() : nullptr;
    if (whole == nullptr) return;
    const auto ticks = whole->window().ticks(), at_a_time = std::max<std::size_t> (1, most_numbers / std::max<std::size_t> (1, capture->components.size()));
    for (int i = 0; i < most_rows_at_a_time && capture->sent < ticks; ++i)
    {
        OSCMessage rows ("/tactus/capture", juce::String::fromUTF8 (capture->name.c_str()), static_cast<juce::int32> (whole->triggeredAt() & 0x7fffffffu), static_cast<juce::int32> (ticks), static_cast<juce::int32> (capture->sent) - static_cast<juce::int32> (whole->window().before));
        for (const auto end = std::min (ticks, capture->sent + at_a_time); capture->sent < end; ++capture->sent)
            for (const double value : whole->frame (capture->sent))
                rows.addFloat32 (static_cast<float> (value));
        port.send (capture->to, rows);
    }
    if (capture->sent < ticks) return;
    capture.reset();
    controlled.endCapture();
}

/// Takes these probes for the ones there are, if all their ports can be looked at together.
std::optional<Message> RemoteControl::look (const std::vector<Probe>& wanted)
{
    std::vector<std::string> ports;
    for (const auto& p : wanted)
        if (std::ranges::find (ports, p.name) == ports.end()) ports.push_back (p.name);
    auto looked_at = controlled.probe (ports);
    if (auto* problem = std::get_if<Message> (&looked_at)) return std::move (*problem);

    components = std::move (std::get<std::vector<std::string>> (looked_at));
    rate_hz = controlled.status().rate_hz;
    probes = wanted;
    for (auto& p : probes)
    {
        p.components.clear();
        for (std::size_t c = 0; c < components.size(); ++c)
            if (isPartOf (components[c], p.name)) p.components.push_back (c);
    }
    return std::nullopt;
}

void RemoteControl::graphChanged()
{
    if (auto again = std::exchange (capture, std::nullopt))
    {
        const auto to = again->to;
        const auto name = again->name;
        again->sent = 0;
        if (const auto problem = arm (std::move (*again))) answer (to, "/tactus/trigger", name, problem);
    }
    if (probes.empty()) return;
    auto before = std::exchange (probes, {});
    look ({});
    for (auto& p : before)
    {
        auto more = probes;
        more.push_back (p);
        if (const auto problem = look (more)) answer (p.to, "/tactus/probe", p.name, problem);
    }
}

void RemoteControl::values (std::uint64_t tick, std::span<const double> now)
{
    for (auto& p : probes)
    {
        if (static_cast<double> (tick) < p.due) continue;
        const double interval = rate_hz / p.rate;
        p.due = p.due + interval > static_cast<double> (tick) ? p.due + interval : static_cast<double> (tick) + interval;
        OSCMessage message ("/tactus/value", juce::String::fromUTF8 (p.name.c_str()), static_cast<juce::int32> (tick & 0x7fffffffu));
        for (const auto c : p.components)
            if (c < now.size()) message.addFloat32 (static_cast<float> (now[c]));
        port.send (p.to, message);
    }
}

void RemoteControl::answer (const OscReturn& to, const std::string& address, const std::string& subject, const std::optional<Message>& problem)
{
    if (to.port == 0) return;
    const auto text = [] (const std::string& s)
    { return juce::String::fromUTF8 (s.c_str()); };
    if (problem)
        port.send (to, OSCMessage ("/tactus/error", text (address), text (subject), text (problem->id), text (problem->text), text (problem->remedy)));
    else
        port.send (to, OSCMessage ("/tactus/done", text (address), text (subject)));
}

}   // namespace tactus::host
