// SPDX-License-Identifier: GPL-3.0-or-later
#include "remote_control.hpp"

#include <host/devices/live/force_causes.hpp>
#include <tactus/run/probe_ring.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace tactus::host
{

namespace
{
using juce::OSCArgument;
using juce::OSCMessage;

constexpr std::string_view transport_addresses = "/tactus/transport/";
constexpr std::size_t most_probes = 16;
constexpr double highest_rate = 1000.0, usual_rate = 50.0;   // of a probe, in Hz
constexpr double longest = 60.0, usual_length = 5.0;         // of a probe or a wait for a trigger, in s
constexpr int usual_before = 100, usual_after = 400;         // ticks before and after a trigger
constexpr int most_at_a_time = 512;                          // messages handled per poll()
constexpr double most_costs = 100, usual_costs = 10;         // number of nodes
constexpr int most_rows_at_a_time = 32;                      // messages with rows of a capture per poll(); few enough that none is lost in transit
constexpr std::size_t most_known = 64;                       // senders that have given the token
constexpr auto longest_silence = std::chrono::minutes (1);   // of such a sender
constexpr std::size_t most_numbers = 60;                     // values per message, since readPacket accepts 64 arguments

std::string textOf (const juce::String& s) { return s.toStdString(); }

juce::String juceText (const std::string& s) { return juce::String::fromUTF8 (s.c_str()); }

/// A name from the graph; the answer may be printed in a terminal.
juce::String nameText (const std::string& s) { return juceText (printableName (s)); }

/// A sentence for an answer, in one line: a name in the sentence must not be able to fake another line of output in a terminal.
std::string inOneLine (std::string text)
{
    std::ranges::replace (text, '\n', ' ');
    return printable (text);
}

/// A number, float or int.
std::optional<double> numberOf (const OSCArgument& a)
{
    if (a.isFloat32()) return a.getFloat32();
    if (a.isInt32()) return a.getInt32();
    return std::nullopt;
}

/// A value; a string is parsed as in --set.
std::optional<Json> valueOf (const OSCArgument& a)
{
    if (a.isString()) return readValue (textOf (a.getString()));
    if (const auto number = numberOf (a)) return Json (*number);
    return std::nullopt;
}

bool isPort (const OSCArgument& a) { return a.isInt32() && a.getInt32() > 0 && a.getInt32() < 65536; }

/// The port for the answer, if the argument at this index is the last one and is a port; 0: no answer.
int answerPort (const OSCMessage& m, int place) { return m.size() == place + 1 && isPort (m[place]) ? m[place].getInt32() : 0; }

RemoteControl::Clock::duration durationOf (double seconds)
{
    return std::chrono::duration_cast<RemoteControl::Clock::duration> (std::chrono::duration<double> (std::min (seconds, longest)));
}

std::optional<Trigger::Edge> edgeOf (const OSCArgument& a)
{
    const auto name = a.isString() ? textOf (a.getString()) : std::string();
    if (name == "rising") return Trigger::Edge::rising;
    if (name == "falling") return Trigger::Edge::falling;
    if (name == "either") return Trigger::Edge::either;
    return std::nullopt;
}

// Forces may rise only if someone at the device can see that no one will be hurt.
constexpr const char* from_elsewhere = "other machines can send this message too, and people there cannot see whether someone at the device could be hurt";

Message badArguments (const std::string& remedy) { return Message::error ("osc/arguments", {}, "this OSC address needs different arguments", remedy); }
}   // namespace

std::vector<RemoteTarget::Role> rolesOf (const RunStatus& status)
{
    std::vector<RemoteTarget::Role> roles;
    for (const auto& r : status.shown())
        roles.push_back ({ .name = std::string (r.name),
                           .withholds = r.stop != Guard::Stop::none,
                           .force = r.force,
                           .torque = r.torque,
                           .last_stop = r.latest == Guard::Stop::none ? std::string() : describe (r.latestEvent()) });
    return roles;
}

std::string randomToken()
{
    std::random_device dice;
    std::string token;
    constexpr int length = 12;   // 2e18 tokens: at 25 600 messages a second, trying all of them takes three million years
    for (int i = 0; i < length; ++i)
        token += "0123456789abcdefghijkmnpqrstuvwxyz"[dice() % 34];   // without l and o, which look like digits
    return token;
}

RemoteControl::RemoteControl (OscPort& p, RemoteTarget& c, std::string t) : port (p), controlled (c), token (std::move (t))
{
    port.onArrival ([&c] (const OSCMessage& m) {
        const auto address = m.getAddressPattern().toString();
        if (address == "/tactus/emergency") c.emergencyNow();
        c.messageArrived();
        return address == "/tactus/emergency" || address == "/tactus/stop";
    });
}

RemoteControl::~RemoteControl() { port.onArrival ({}); }

void RemoteControl::poll (Clock::time_point now)
{
    for (int i = 0; i < most_at_a_time; ++i)
        if (const auto received = port.receive())
        {
            arrived_at = received->at;
            carryOut (*received, now);
        }
        else
            break;

    const auto left = std::erase_if (probes, [&] (const Probe& p) { return now >= p.end; });
    if (left > 0 && probes.empty()) static_cast<void> (listenTo ({}));

    sendCapture();
    if (capture && capture->sent == 0 && now >= capture->end)
    {
        capture.reset();
        controlled.endCapture();
    }
}

void RemoteControl::carryOut (const OscPort::ReceivedMessage& received, Clock::time_point now)
{
    const auto& m = received.message;
    const auto& host = received.host;
    const auto address = textOf (m.getAddressPattern().toString());
    const auto subject = m.size() > 0 && m[0].isString() ? textOf (m[0].getString()) : std::string();
    const auto last = [&] (int place) { return OscReturn { host, answerPort (m, place) }; };
    const auto obey = [&] (int place, auto act) {
        const auto may = raisesForce (address) ? mayRaise (received.from, now) : Result<> {};
        answer (last (place), address, subject, may ? act() : may);
    };

    if (address == "/tactus/hello")
        answer (last (subject.empty() ? 0 : 1), address, "", hello (subject, received.from, now));
    else if (address == "/tactus/param" || address == "/tactus/control")
        obey (2, [&] { return turn (address, subject, m); });
    else if (address == "/tactus/hit")
    {
        const auto speed = m.size() >= 2 ? numberOf (m[1]) : std::nullopt;
        const bool right = ! subject.empty() && speed && m.size() <= 3;
        obey (2, [&] {
            return right ? controlled.strike (subject, *speed)
                         : badArguments ("send the name of a hit input, a speed in m/s (float or int), and optionally the UDP port for the answer");
        });
    }
    else if (address.starts_with (transport_addresses))
        obey (1, [&] { return transport (address.substr (transport_addresses.size()), m); });
    else if (address == "/tactus/start")
        obey (0, [&] { return start(); });
    else if (address == "/tactus/rearm")
        answer (last (subject.empty() ? 0 : 1), address, "", rearm (subject));   // with a token of its own, also without a real device
    else if (address == "/tactus/stop" || address == "/tactus/emergency")
    {
        if (address == "/tactus/stop")
            controlled.stop();
        else
            controlled.emergencyStop();
        answer (last (0), address, "", {});
    }
    else if (! host.empty())   // the other messages are useful only to a sender that gets answers
        report (address, subject, m, host, now);
}

/// Sets a parameter or moves a control.
Result<> RemoteControl::turn (const std::string& address, const std::string& name, const OSCMessage& m)
{
    const auto value = m.size() >= 2 ? valueOf (m[1]) : std::nullopt;
    if (name.empty() || ! value || m.size() > 3)
        return badArguments ("send the name of a parameter or control, a value (float, int, or a string with a unit), "
                             "and optionally the UDP port for the answer");
    if (address == "/tactus/param") return controlled.setParam (name, *value);
    return controlled.turnControl (name, value->is_number() ? value->get<double>() : std::nan (""));
}

/// Handles requests for data. Does nothing without a valid port for the answer.
void RemoteControl::report (const std::string& address, const std::string& subject, const OSCMessage& m, const std::string& host, Clock::time_point now)
{
    const bool subscribes = address == "/tactus/probe" || address == "/tactus/trigger";
    const int place = subscribes ? 1 : 0;
    const bool has_port = m.size() > place && isPort (m[place]);
    const OscReturn to { host, has_port ? m[place].getInt32() : 0 };

    if (subscribes)
    {
        if (auto done = address == "/tactus/probe" ? subscribe (m, host, now) : subscribeCapture (m, host, now); ! done) answer (to, address, subject, done);
    }
    else if (! has_port)
        return;
    else if (address == "/tactus/status" && m.size() == 1)
    {
        const auto s = controlled.status();
        const auto whole = [] (std::uint64_t n) { return static_cast<juce::int32> (n & 0x7fffffffu); };
        port.send (to, OSCMessage ("/tactus/status", nameText (s.name), static_cast<float> (s.rate_hz), static_cast<float> (s.time_s),
                                   static_cast<float> (s.force), static_cast<float> (s.peak), whole (s.ticks), whole (s.misses)));
    }
    else if (address == "/tactus/costs" && m.size() <= 2)
    {
        const auto wanted = m.size() > 1 ? numberOf (m[1]) : std::optional (usual_costs);
        if (wanted && *wanted >= 1.0)
            sendCosts (to, static_cast<std::size_t> (std::min (*wanted, most_costs)));
        else
            answer (to, address, "", badArguments ("send the UDP port for the answer, and optionally the number of nodes to list"));
    }
    else if (address == "/tactus/guard" && m.size() == 1)
        sendRoles (to);
}

void RemoteControl::sendCosts (const OscReturn& to, std::size_t most)
{
    auto costs = controlled.costs();
    costs.resize (std::min (costs.size(), most));
    for (const auto& c : costs)
        port.send (to, OSCMessage ("/tactus/cost", nameText (c.node), nameText (c.type), static_cast<float> (c.mean_s), static_cast<float> (c.share)));
    answer (to, "/tactus/costs", "", {});
}

void RemoteControl::sendRoles (const OscReturn& to)
{
    for (const auto& r : controlled.roles())
        port.send (to, OSCMessage ("/tactus/guard", nameText (r.name), static_cast<juce::int32> (r.withholds), static_cast<float> (r.force),
                                   static_cast<float> (r.torque), nameText (r.last_stop)));
    answer (to, "/tactus/guard", "", {});
}

Result<> RemoteControl::start()
{
    if (! port.listensTo().isLoopback()) return Message::error ("osc/start", {}, from_elsewhere, "start the run on the machine that has the device");
    return controlled.start();
}

Result<> RemoteControl::rearm (const std::string& given)
{
    if (! port.listensTo().isLoopback())
        return Message::error ("osc/rearm", {}, from_elsewhere,
                               "rearm on the machine that has the device: with R in the terminal of play, or with REARM in the window");
    if (auto right = checkToken ("osc/rearm", given); ! right) return right;
    return controlled.rearm (arrived_at);
}

Result<> RemoteControl::checkToken (const char* id, const std::string& given)
{
    if (! token.empty() && given == token) return {};
    return Message::error (id, {}, given.empty() ? "this needs the token of the run" : "the token is wrong",
                           token.empty() ? "press REARM in the window" : "give the token that play printed (docs/osc.md), or press R in its terminal");
}

/// A sender is a socket and not a machine, because all programs and users of this machine share its address. Without a token, the sender
/// is forgotten, so that a program that gets its port number later does not take its place.
Result<> RemoteControl::hello (const std::string& given, const std::string& from, Clock::time_point now)
{
    known.erase (from);
    if (given.empty()) return {};
    if (auto right = checkToken ("osc/token", given); ! right) return right;
    if (known.size() >= most_known) known.erase (std::ranges::min_element (known, {}, [] (const auto& k) { return k.second; }));
    known[from] = now;
    return {};
}

Result<> RemoteControl::mayRaise (const std::string& from, Clock::time_point now)
{
    if (! controlled.drivesDevice()) return {};
    std::erase_if (known, [&] (const auto& k) { return now - k.second > longest_silence; });
    if (const auto sender = known.find (from); sender != known.end())
    {
        sender->second = now;
        return {};
    }
    return Message::error ("osc/token", {}, "the run drives a real device, and this program has not shown that its user may do that",
                           "send /tactus/hello with the token of the run from the same socket (docs/osc.md); `tactus set` of the same user does so");
}

Result<> RemoteControl::transport (const std::string& what, const OSCMessage& m)
{
    const auto value = m.size() >= 1 && m.size() <= 2 ? numberOf (m[0]) : std::nullopt;
    if (what == "play" && value) return controlled.transport ({ .plays = *value != 0.0 });
    if (what == "seek" && value && *value >= 0.0) return controlled.transport ({ .seek = value });
    if (what == "speed" && value && *value > 0.0) return controlled.transport ({ .speed = value });
    return badArguments ("send /tactus/transport/play 0 or 1, /tactus/transport/seek s, or /tactus/transport/speed factor; "
                         "and optionally the UDP port for the answer");
}

Result<> RemoteControl::subscribe (const OSCMessage& m, const std::string& host, Clock::time_point now)
{
    const auto number = [&] (int i, double otherwise) { return m.size() > i ? numberOf (m[i]) : std::optional (otherwise); };
    const auto rate = number (2, usual_rate), length = number (3, usual_length);
    if (m.size() < 2 || m.size() > 4 || ! m[0].isString() || ! isPort (m[1]) || ! rate || ! length || ! (*rate > 0.0) || ! (*length > 0.0))
        return badArguments ("send the name of the graph port to probe, the UDP port for the answers, and optionally the rate (Hz) and the duration (s)");

    Probe probe {
        .name = textOf (m[0].getString()), .to = { host, m[1].getInt32() }, .rate = std::min (*rate, highest_rate), .end = now + durationOf (*length)
    };
    const auto same = std::ranges::find_if (probes, [&] (const Probe& p) { return p.name == probe.name && p.to == probe.to; });
    if (same != probes.end())
    {
        same->rate = probe.rate;
        same->end = probe.end;
    }
    else
    {
        if (probes.size() >= most_probes)
            return Message::error ("probe/too_many", {}, "there are already " + std::to_string (most_probes) + " probes", "wait until one of the probes ends");
        auto more = probes;
        more.push_back (probe);
        if (auto looked = listenTo (more); ! looked) return looked;
    }

    const auto& now_probed = *std::ranges::find_if (probes, [&] (const Probe& p) { return p.name == probe.name && p.to == probe.to; });
    OSCMessage done ("/tactus/done", juce::String ("/tactus/probe"), juceText (probe.name), static_cast<float> (rate_hz));
    for (const auto c : now_probed.components)
        done.addString (nameText (components[c]));
    port.send (probe.to, done);
    return {};
}

Result<> RemoteControl::subscribeCapture (const OSCMessage& m, const std::string& host, Clock::time_point now)
{
    const auto whole = [&] (int i, int otherwise) {
        if (m.size() <= i) return otherwise;
        return m[i].isInt32() ? m[i].getInt32() : -1;
    };
    const auto number = [&] (int i, double otherwise) { return m.size() <= i ? otherwise : numberOf (m[i]).value_or (std::nan ("")); };
    const double level = number (3, std::nan ("")), length = number (7, usual_length);
    const auto edge = m.size() > 4 ? edgeOf (m[4]) : std::optional (Trigger::Edge::rising);
    const int before = whole (5, usual_before), after = whole (6, usual_after);
    if (m.size() < 4 || m.size() > 8 || ! m[0].isString() || ! isPort (m[1]) || ! m[2].isString() || ! std::isfinite (level) || ! edge || before < 0
        || after < 0 || ! (length > 0.0))
        return badArguments (
            "send the name of the graph port to capture, the UDP port for the answers, the name of the graph port that triggers, the trigger level, and "
            "optionally rising, falling or either, the ticks before, the ticks after, and the longest wait (s)");

    Capture wanted { .name = textOf (m[0].getString()),
                     .watched = textOf (m[2].getString()),
                     .to = { host, m[1].getInt32() },
                     .trigger = { level, *edge, static_cast<std::size_t> (before), static_cast<std::size_t> (after) },
                     .end = now + durationOf (length) };
    if (! capture) return arm (std::move (wanted));
    if (capture->to != wanted.to || capture->name != wanted.name)
        return Message::error ("probe/busy", {}, "another client is waiting for a trigger", "wait until its capture ends");
    capture->end = wanted.end;
    confirmCapture();
    return {};
}

Result<> RemoteControl::arm (Capture wanted)
{
    auto armed = controlled.capture (wanted.name, wanted.watched, wanted.trigger);
    if (! armed) return armed.error();
    wanted.components = std::move (*armed);
    capture = std::move (wanted);
    confirmCapture();
    return {};
}

void RemoteControl::confirmCapture()
{
    OSCMessage done ("/tactus/done", juce::String ("/tactus/trigger"), juceText (capture->name), static_cast<float> (controlled.status().rate_hz));
    for (const auto& name : capture->components)
        done.addString (nameText (name));
    port.send (capture->to, done);
}

void RemoteControl::sendCapture()
{
    const auto* whole = capture ? controlled.captured() : nullptr;
    if (whole == nullptr) return;
    const auto ticks = whole->window().ticks(), at_a_time = std::max<std::size_t> (1, most_numbers / std::max<std::size_t> (1, capture->components.size()));
    for (int i = 0; i < most_rows_at_a_time && capture->sent < ticks; ++i)
    {
        OSCMessage rows ("/tactus/capture", juceText (capture->name), static_cast<juce::int32> (whole->triggeredAt() & 0x7fffffffu),
                         static_cast<juce::int32> (ticks), static_cast<juce::int32> (capture->sent) - static_cast<juce::int32> (whole->window().before));
        for (const auto end = std::min (ticks, capture->sent + at_a_time); capture->sent < end; ++capture->sent)
            for (const double value : whole->frame (capture->sent))
                rows.addFloat32 (static_cast<float> (value));
        port.send (capture->to, rows);
    }
    if (capture->sent < ticks) return;
    capture.reset();
    controlled.endCapture();
}

/// Replaces all probes with these, if all their ports can be probed together.
Result<> RemoteControl::listenTo (const std::vector<Probe>& wanted)
{
    std::vector<std::string> ports;
    for (const auto& p : wanted)
        if (std::ranges::find (ports, p.name) == ports.end()) ports.push_back (p.name);
    auto looked_at = controlled.probe (ports);
    if (! looked_at) return looked_at.error();

    components = std::move (*looked_at);
    rate_hz = controlled.status().rate_hz;
    probes = wanted;
    for (auto& p : probes)
    {
        p.components.clear();
        for (std::size_t c = 0; c < components.size(); ++c)
            if (isPartOf (components[c], p.name)) p.components.push_back (c);
    }
    return {};
}

void RemoteControl::graphChanged()
{
    if (auto again = std::exchange (capture, std::nullopt))
    {
        const auto to = again->to;
        const auto name = again->name;
        again->sent = 0;
        if (const auto armed = arm (std::move (*again)); ! armed) answer (to, "/tactus/trigger", name, armed);
    }
    if (probes.empty()) return;
    auto before = std::exchange (probes, {});
    static_cast<void> (listenTo ({}));
    for (auto& p : before)
    {
        auto more = probes;
        more.push_back (p);
        if (const auto looked = listenTo (more); ! looked) answer (p.to, "/tactus/probe", p.name, looked);
    }
}

void RemoteControl::values (std::uint64_t tick, std::span<const double> now)
{
    for (auto& p : probes)
    {
        if (static_cast<double> (tick) < p.due) continue;
        const double interval = rate_hz / p.rate;
        p.due = p.due + interval > static_cast<double> (tick) ? p.due + interval : static_cast<double> (tick) + interval;
        OSCMessage message ("/tactus/value", juceText (p.name), static_cast<juce::int32> (tick & 0x7fffffffu));
        for (const auto c : p.components)
            if (c < now.size()) message.addFloat32 (static_cast<float> (now[c]));
        port.send (p.to, message);
    }
}

void RemoteControl::answer (const OscReturn& to, const std::string& address, const std::string& subject, const Result<>& done)
{
    if (to.port == 0) return;
    if (done) return port.send (to, OSCMessage ("/tactus/done", juceText (address), juceText (subject)));
    const auto& why = done.error();
    port.send (to, OSCMessage ("/tactus/error", juceText (address), juceText (subject), juceText (why.id), juceText (inOneLine (why.text)),
                               juceText (inOneLine (why.remedy))));
}

}   // namespace tactus::host
