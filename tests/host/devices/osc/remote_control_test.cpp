// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/live/force_causes.hpp>
#include <host/devices/osc/remote_control.hpp>
#include <host/devices/osc/token_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <limits>

using namespace tactus;
using namespace tactus::host;
using namespace std::chrono_literals;
using juce::OSCMessage;
using juce::String;

namespace
{
/// Records the calls it gets.
struct Puppet : RemoteTarget
{
    Result<> setParam (const std::string& name, const Json& value) override
    {
        said = name + " = " + value.dump();
        if (name != "drag.mu") return Message::error ("param/unknown", {}, "no such parameter", "try drag.mu");
        return {};
    }

    Result<> turnControl (const std::string& id, double value) override
    {
        said = id + " at " + std::to_string (value);
        return {};
    }

    Result<> strike (const std::string& input, double speed) override
    {
        said = input + " hit at " + std::to_string (speed);
        if (input != "ring.hit") return Message::error ("hit/unknown", {}, "no such input", "try ring.hit");
        return {};
    }

    Result<std::vector<std::string>> probe (const std::vector<std::string>& ports) override
    {
        std::vector<std::string> names;
        const auto add = [&] (const std::string& name) {
            if (std::ranges::find (names, name) == names.end()) names.push_back (name);
        };
        for (const auto& p : ports)
            if (p == "drag.force" && ! force_is_gone)
                for (const auto* axis : { ".x", ".y", ".z" })
                    add (p + axis);
            else if (p == "drag.force.y" || p == "drag.state" || p.starts_with ("n."))
                add (p);
            else
                return Message::error ("port/unknown", {}, "no such port");
        probed = ports;
        return names;
    }

    Result<std::vector<std::string>> capture (const std::string& port, const std::string& watched, const Trigger& trigger) override
    {
        if (watched == "drag.nothing") return Message::error ("port/unknown", {}, "no such port");
        said = port + " by " + watched + " at " + std::to_string (trigger.level);
        wanted = trigger;
        capturing = std::make_unique<TriggeredCapture> (trigger, 1, std::vector<std::size_t> { 0, 1 }, 1);
        return std::vector<std::string> { port + ".x", port + ".y" };
    }
    std::string graph_name = "Puppet";
    const TriggeredCapture* captured() override { return capturing && capturing->isComplete() ? capturing.get() : nullptr; }
    void endCapture() override { capturing.reset(); }

    Status status() override { return { graph_name, 1000.0, 2.5, 0.5, 1.5, 2500, 3 }; }
    std::vector<NodeCost> costs() override { return std::vector<NodeCost> (20, { "wood/drag", "friction.elasto_plastic", 2e-6, 0.05 }); }
    std::vector<Role> roles() override { return { { "stylus", true, 0.25, 0.0, "the last reading is 31 ms old" }, { "thumb", false, 0.0, 0.0, {} } }; }
    Result<> transport (const Transport& t) override
    {
        said = "plays " + std::to_string (t.plays.value_or (true)) + ", to " + std::to_string (t.seek.value_or (-1.0)) + ", at "
               + std::to_string (t.speed.value_or (-1.0));
        return {};
    }
    bool drivesDevice() override { return drives_device; }
    Result<> start() override { return Message::error ("osc/start", {}, "it is already running"); }
    void stop() override { stopped = true; }
    void emergencyStop() override { emergency = true; }
    void emergencyNow() noexcept override { ++emergencies_now; }
    Result<> rearm (std::chrono::steady_clock::time_point) override
    {
        emergency = false;
        return {};
    }

    std::string said;
    std::vector<std::string> probed;
    bool stopped = false, emergency = false, force_is_gone = false, drives_device = false;
    std::atomic<int> emergencies_now = 0;
    Trigger wanted;
    std::unique_ptr<TriggeredCapture> capturing;
};

/// Feeds a capture with x = k, and y = 1 from tick `edge`.
void run (TriggeredCapture& capture, int ticks, int edge)
{
    double values[2] {};
    const Plan plan ({ { .name = "x", .unit = {}, .value = &values[0] }, { .name = "y", .unit = {}, .value = &values[1] } });
    for (int k = 0; k < ticks; ++k)
    {
        values[0] = k;
        values[1] = k >= edge;
        capture.note (plan, static_cast<std::uint64_t> (k));
    }
}

struct Stage
{
    explicit Stage (const OscListen& where = {}) : port (std::move (*OscPort::open (where))), other (std::move (*OscPort::open (0))),
                                                   control (*port, puppet, "a1b2c3") {}

    /// Sends a message, lets it be handled, and returns the answer. Waits for the receiving thread of the port.
    template <typename... Args>
    OSCMessage ask (const char* address, Args... args)
    {
        send (address, args...);
        auto answer = other->next (20s);
        REQUIRE (answer);
        return *answer;
    }

    /// Sends a message, and then a second one that is answered, which shows that the first one has been handled.
    template <typename... Args>
    void send (const char* address, Args... args)
    {
        other->send (port->number(), OSCMessage (address, args...));
        const auto marker = std::move (*OscPort::open (0));
        other->send (port->number(), OSCMessage ("/tactus/status", marker->number()));
        for (int i = 0; i < 4000; ++i)
        {
            control.poll (now);
            if (marker->next (5ms)) return;
        }
        FAIL ("no message arrived");
    }

    int me() const { return other->number(); }

    std::unique_ptr<OscPort> port, other;
    Puppet puppet;
    RemoteControl control;
    RemoteControl::Clock::time_point now {};
};

std::string address (const OSCMessage& m) { return m.getAddressPattern().toString().toStdString(); }

std::string text (const OSCMessage& m, int i) { return m.size() > i && m[i].isString() ? m[i].getString().toStdString() : std::string(); }
}   // namespace

TEST_CASE ("parameters are set by numbers, and by strings that give exact doubles", "[osc]")
{
    Stage stage;
    const auto said = [&] (auto value) {
        const auto answer = stage.ask ("/tactus/param", String ("drag.mu"), value, stage.me());
        CHECK (address (answer) == "/tactus/done");
        CHECK (text (answer, 0) == "/tactus/param");
        CHECK (text (answer, 1) == "drag.mu");
        return stage.puppet.said;
    };
    CHECK (said (0.5f) == "drag.mu = 0.5");
    CHECK (said (2) == "drag.mu = 2.0");
    CHECK (said (String ("0.1")) == "drag.mu = 0.1");
    CHECK (said (String ("20 um")) == "drag.mu = \"20 um\"");
    CHECK (said (String ("[1,2]")) == "drag.mu = [1,2]");

    const auto refused = stage.ask ("/tactus/param", String ("drag.nu"), 1.0f, stage.me());
    CHECK (address (refused) == "/tactus/error");
    CHECK (text (refused, 2) == "param/unknown");
    CHECK (text (refused, 4) == "try drag.mu");

    stage.send ("/tactus/param", String ("drag.mu"), 0.25f);   // no answer
    CHECK (stage.puppet.said == "drag.mu = 0.25");
    CHECK_FALSE (stage.other->next());
    CHECK (text (stage.ask ("/tactus/control", String ("rough"), 0.75f, stage.me()), 1) == "rough");
    CHECK (stage.puppet.said == "rough at 0.750000");
}

TEST_CASE ("wrong arguments are refused and have no effect", "[osc]")
{
    Stage stage;
    stage.puppet.said.clear();
    stage.send ("/tactus/param");
    stage.send ("/tactus/param", String ("drag.mu"));
    stage.send ("/tactus/param", 1.0f, 1.0f);
    stage.send ("/tactus/param", String ("drag.mu"), 1.0f, 2, 3);
    stage.send ("/tactus/probe");
    stage.send ("/tactus/probe", String ("drag.force"), 70000);
    stage.send ("/tactus/probe", String ("drag.force"), -1, 5.0f);
    stage.send ("/tactus/status");
    stage.send ("/tactus/status", String ("x"));
    stage.send ("/tactus/unknown", 1);
    CHECK (stage.puppet.said.empty());
    CHECK (stage.puppet.probed.empty());
    CHECK_FALSE (stage.other->next());
    for (const float bad : { 0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN() })
        CHECK (text (stage.ask ("/tactus/probe", String ("drag.force"), stage.me(), bad), 2) == "osc/arguments");
}

TEST_CASE ("a run reports its status, and stops on request", "[osc]")
{
    Stage stage;
    const auto status = stage.ask ("/tactus/status", stage.me());
    REQUIRE (status.size() == 7);
    CHECK (text (status, 0) == "Puppet");
    CHECK (status[1].getFloat32() == 1000.0f);
    CHECK (status[5].getInt32() == 2500);
    CHECK (status[6].getInt32() == 3);
    CHECK_FALSE (stage.puppet.stopped);
    stage.send ("/tactus/stop");
    CHECK (stage.puppet.stopped);
}

TEST_CASE ("a name from a file is escaped and cut in an answer", "[osc]")
{
    Stage stage;
    stage.puppet.graph_name = "a\n\x1b]0;b\x07" + std::string (300, 'x');
    const auto name = text (stage.ask ("/tactus/status", stage.me()), 0);
    CHECK (name.find ("a\\x0A\\x1B]0;b\\x07xx") == 0);
    CHECK (name.size() == 200 + std::string ("…").size());
}

TEST_CASE ("the emergency stop works, and rearm ends it", "[osc]")
{
    Stage stage;
    CHECK (text (stage.ask ("/tactus/emergency", stage.me()), 0) == "/tactus/emergency");
    CHECK (stage.puppet.emergency);
    CHECK_FALSE (stage.puppet.stopped);
    CHECK (text (stage.ask ("/tactus/rearm", stage.me()), 2) == "osc/rearm");   // it needs the token
    CHECK (text (stage.ask ("/tactus/rearm", String ("a1b2c4"), stage.me()), 2) == "osc/rearm");
    CHECK (stage.puppet.emergency);
    CHECK (text (stage.ask ("/tactus/rearm", String ("a1b2c3"), stage.me()), 0) == "/tactus/rearm");
    CHECK_FALSE (stage.puppet.emergency);

    Stage open { OscListen { .address = "0.0.0.0" } };   // open to other machines, whose users cannot see the device
    open.ask ("/tactus/emergency", open.me());
    CHECK (text (open.ask ("/tactus/rearm", String ("a1b2c3"), open.me()), 2) == "osc/rearm");
    CHECK (open.puppet.emergency);
}

TEST_CASE ("an emergency stop over OSC passes all messages that wait, and needs no room among them", "[osc]")
{
    Stage stage;
    constexpr int flood = 5000;   // more than fit into the queue; nothing handles them
    for (int i = 0; i < flood; ++i)
    {
        stage.other->send (stage.port->number(), OSCMessage ("/tactus/param", String ("drag.mu"), 0.5f));
        if (i % 100 == 99) stage.other->send (stage.port->number(), OSCMessage ("/tactus/emergency"));
    }
    CHECK (tactus::test::eventually (5ms, [&] {
        stage.other->send (stage.port->number(), OSCMessage ("/tactus/emergency"));
        return stage.puppet.emergencies_now > 0;
    }));
    CHECK_FALSE (stage.puppet.emergency);   // the main thread has not handled a single message
}

TEST_CASE ("a stop over OSC is not dropped, however many messages wait", "[osc][safety]")
{
    Stage stage;
    const auto flood = [&] { stage.other->send (stage.port->number(), OSCMessage ("/tactus/param", String ("drag.mu"), 0.5f)); };
    while (stage.port->dropped() == 0)
        flood();
    CHECK (tactus::test::eventually (1ms, [&] {   // the system may drop some of them
        stage.other->send (stage.port->number(), OSCMessage ("/tactus/stop"));
        stage.other->send (stage.port->number(), OSCMessage ("/tactus/emergency"));
        flood();
        return stage.puppet.emergencies_now >= 20;
    }));
    for (int before = -1; before != stage.puppet.emergencies_now;)   // what the system still holds must not come into the queue as it empties
    {
        before = stage.puppet.emergencies_now;
        tactus::test::letPass (20ms);
    }
    for (int i = 0; i < 20; ++i)
        stage.control.poll (stage.now);
    CHECK (stage.puppet.stopped);
    CHECK (stage.puppet.emergency);
}

TEST_CASE ("wrong tokens from a stranger do not delay messages with the right one", "[osc][safety]")
{
    Stage stage;
    stage.puppet.drives_device = true;
    const auto stranger = std::move (*OscPort::open (0));
    const auto guess = [&] {
        stranger->send (stage.port->number(), OSCMessage ("/tactus/hello", String ("a1b2c4"), stranger->number()));
        std::optional<OSCMessage> answer;
        while (! answer)
        {
            stage.control.poll (stage.now);
            answer = stranger->next (5ms);
        }
        CHECK (text (*answer, 2) == "osc/token");
    };
    guess();
    CHECK (text (stage.ask ("/tactus/hello", String ("a1b2c3"), stage.me()), 0) == "/tactus/hello");
    guess();
    CHECK (text (stage.ask ("/tactus/rearm", String ("a1b2c3"), stage.me()), 0) == "/tactus/rearm");
    guess();
    CHECK (text (stage.ask ("/tactus/param", String ("drag.mu"), 0.3f, stage.me()), 0) == "/tactus/param");

    const auto token = tactus::host::randomToken();   // so long that guesses are hopeless
    CHECK (token.size() == 12);
    CHECK (token != tactus::host::randomToken());
}

TEST_CASE ("a probe sends the requested values at the requested rate, and ends in time", "[osc]")
{
    Stage stage;
    const auto done = stage.ask ("/tactus/probe", String ("drag.force"), stage.me(), 100.0f, 2.0f);
    REQUIRE (done.size() == 6);
    CHECK (done[2].getFloat32() == 1000.0f);
    CHECK (text (done, 5) == "drag.force.z");
    const auto again = std::move (*OscPort::open (0));
    stage.send ("/tactus/probe", String ("drag.force.y"), again->number(), 1000.0f, 2.0f);
    CHECK (text (*again->next (20s), 3) == "drag.force.y");

    for (std::uint64_t tick = 5000; tick < 5100; ++tick)
        stage.control.values (tick, std::vector<double> { 1.0, 2.0, 3.0 });
    for (int i = 0; i < 10; ++i)
    {
        const auto value = stage.other->next (20s);
        REQUIRE (value);
        CHECK (text (*value, 0) == "drag.force");
        CHECK ((*value)[1].getInt32() == 5000 + 10 * i);
        REQUIRE (value->size() == 5);
        CHECK ((*value)[4].getFloat32() == 3.0f);
    }
    CHECK_FALSE (stage.other->next (50ms));
    for (int i = 0; i < 100; ++i)
        CHECK ((*again->next (20s))[2].getFloat32() == 2.0f);

    stage.now += 1900ms;
    stage.control.poll (stage.now);
    CHECK (stage.control.isProbing());
    stage.ask ("/tactus/probe", String ("drag.force"), stage.me(), 100.0f, 2.0f);   // continues the probe
    stage.now += 200ms;
    stage.control.poll (stage.now);
    stage.control.values (9000, std::vector<double> { 1.0, 2.0, 3.0 });
    CHECK (address (*stage.other->next (20s)) == "/tactus/value");
    CHECK_FALSE (again->next (50ms));
    stage.now += 2s;
    stage.control.poll (stage.now);
    CHECK_FALSE (stage.control.isProbing());
    CHECK (stage.puppet.probed.empty());
}

TEST_CASE ("on request, the costs of the most expensive nodes are sent, node by node", "[osc]")
{
    Stage stage;
    const auto told = [&] (auto... how_many) {
        auto message = stage.ask ("/tactus/costs", stage.me(), how_many...);
        int n = 0;
        for (; address (message) == "/tactus/cost"; ++n)
        {
            CHECK (text (message, 0) == "wood/drag");
            CHECK (text (message, 1) == "friction.elasto_plastic");
            CHECK (message[2].getFloat32() == 2e-6f);
            CHECK (message[3].getFloat32() == 0.05f);
            message = *stage.other->next (20s);
        }
        CHECK (address (message) == "/tactus/done");
        CHECK (text (message, 0) == "/tactus/costs");
        return n;
    };
    CHECK (told() == 10);
    CHECK (told (3) == 3);
    CHECK (told (1000.0f) == 20);
    CHECK (text (stage.ask ("/tactus/costs", stage.me(), 0), 2) == "osc/arguments");
}

TEST_CASE ("a probe of an unknown port, or one too many, is refused, and the others continue", "[osc]")
{
    Stage stage;
    stage.ask ("/tactus/probe", String ("drag.state"), stage.me());
    const auto refused = stage.ask ("/tactus/probe", String ("drag.nothing"), stage.me());
    CHECK (text (refused, 1) == "drag.nothing");
    CHECK (text (refused, 2) == "port/unknown");
    CHECK (stage.puppet.probed == std::vector<std::string> { "drag.state" });
    for (int i = 0; i < 15; ++i)
        CHECK (address (stage.ask ("/tactus/probe", String ("n.p" + std::to_string (i)), stage.me())) == "/tactus/done");
    CHECK (text (stage.ask ("/tactus/probe", String ("n.more"), stage.me()), 2) == "probe/too_many");
    CHECK (stage.puppet.probed.size() == 16);
}

TEST_CASE ("after a change of the graph, probes continue if their ports still exist", "[osc]")
{
    Stage stage;
    stage.ask ("/tactus/probe", String ("drag.force"), stage.me());
    stage.ask ("/tactus/probe", String ("drag.state"), stage.me());
    stage.puppet.force_is_gone = true;
    stage.control.graphChanged();
    const auto gone = stage.other->next (20s);
    REQUIRE (gone);
    CHECK (address (*gone) == "/tactus/error");
    CHECK (text (*gone, 1) == "drag.force");
    stage.control.values (1, std::vector<double> { 7.0 });
    const auto value = stage.other->next (20s);
    REQUIRE (value);
    CHECK (text (*value, 0) == "drag.state");
    CHECK ((*value)[2].getFloat32() == 7.0f);
}

TEST_CASE ("a trigger sends its complete window, then ends", "[osc]")
{
    Stage stage;
    const auto done = stage.ask ("/tactus/trigger", String ("drag.force"), stage.me(), String ("drag.state"), 0.5f, String ("either"), 20, 1000);
    CHECK (address (done) == "/tactus/done");
    CHECK (text (done, 0) == "/tactus/trigger");
    CHECK (done[2].getFloat32() == 1000.0f);
    CHECK (text (done, 4) == "drag.force.y");
    CHECK (stage.puppet.said == "drag.force by drag.state at 0.500000");
    CHECK (stage.puppet.wanted.edge == Trigger::Edge::either);
    CHECK (stage.puppet.wanted.before == 20);
    CHECK (stage.puppet.wanted.after == 1000);

    run (*stage.puppet.capturing, 2000, 300);
    int next = -20;
    stage.control.poll (stage.now);
    stage.control.poll (stage.now);   // the window is sent in several parts
    for (;;)
    {
        const auto rows = stage.other->next (next < 1001 ? 20s : 50ms);
        if (! rows) break;
        REQUIRE (address (*rows) == "/tactus/capture");
        CHECK (text (*rows, 0) == "drag.force");
        CHECK ((*rows)[1].getInt32() == 300);
        CHECK ((*rows)[2].getInt32() == 1021);
        CHECK ((*rows)[3].getInt32() == next);
        int wrong = 0;
        for (int i = 4; i + 1 < rows->size(); i += 2, ++next)
        {
            wrong += (*rows)[i].getFloat32() != static_cast<float> (300 + next);
            wrong += (*rows)[i + 1].getFloat32() != (next >= 0 ? 1.0f : 0.0f);
        }
        CHECK (wrong == 0);
    }
    CHECK (next == 1001);
    CHECK_FALSE (stage.puppet.capturing);
}

TEST_CASE ("only one trigger is awaited at a time, until it expires", "[osc]")
{
    Stage stage;
    const auto id = [] (const OSCMessage& m) { return address (m) == "/tactus/error" ? text (m, 2) : address (m); };
    CHECK (id (stage.ask ("/tactus/trigger", String ("drag.force"), stage.me(), String ("drag.nothing"), 0.5f)) == "port/unknown");
    CHECK (id (stage.ask ("/tactus/trigger", String ("drag.force"), stage.me(), String ("drag.state"))) == "osc/arguments");
    for (const auto* edge : { "up", "" })
        CHECK (id (stage.ask ("/tactus/trigger", String ("drag.force"), stage.me(), String ("drag.state"), 0.5f, String (edge))) == "osc/arguments");
    CHECK (id (stage.ask ("/tactus/trigger", String ("drag.force"), stage.me(), String ("drag.state"), 0.5f, String ("rising"), -1)) == "osc/arguments");
    CHECK (id (stage.ask ("/tactus/trigger", String ("drag.force"), stage.me(), String ("drag.state"), std::numeric_limits<float>::quiet_NaN()))
           == "osc/arguments");
    CHECK_FALSE (stage.puppet.capturing);

    const auto ask = [&] (const char* port) { return id (stage.ask ("/tactus/trigger", String (port), stage.me(), String ("drag.state"), 0.5f)); };
    CHECK (ask ("drag.force") == "/tactus/done");
    CHECK (ask ("drag.state") == "probe/busy");
    stage.now += 4s;
    CHECK (ask ("drag.force") == "/tactus/done");   // the probe continues
    stage.now += 4s;
    stage.control.poll (stage.now);
    CHECK (stage.puppet.capturing);
    stage.control.graphChanged();
    CHECK (address (*stage.other->next (20s)) == "/tactus/done");
    stage.now += 2s;
    stage.control.poll (stage.now);
    CHECK_FALSE (stage.puppet.capturing);
    CHECK (ask ("drag.state") == "/tactus/done");
}

TEST_CASE ("on request, the state of each guard and its last stop are sent", "[osc]")
{
    Stage stage;
    const auto first = stage.ask ("/tactus/guard", stage.other->number());
    CHECK (first.getAddressPattern().toString() == "/tactus/guard");
    CHECK (first[0].getString() == "stylus");
    CHECK (first[1].getInt32() == 1);
    CHECK (first[2].getFloat32() == 0.25f);
    CHECK (first[4].getString() == "the last reading is 31 ms old");
    const auto second = stage.other->next (20s), done = stage.other->next (20s);
    REQUIRE (second);
    CHECK ((*second)[0].getString() == "thumb");
    REQUIRE (done);
    CHECK (done->getAddressPattern().toString() == "/tactus/done");
}

TEST_CASE ("OSC plays, pauses, seeks and slows down a gesture or a recording", "[osc]")
{
    Stage stage;
    CHECK (stage.ask ("/tactus/transport/play", 0, stage.other->number()).getAddressPattern().toString() == "/tactus/done");
    CHECK (stage.puppet.said.starts_with ("plays 0"));
    stage.ask ("/tactus/transport/seek", 1.5f, stage.other->number());
    CHECK (stage.puppet.said == "plays 1, to 1.500000, at -1.000000");
    stage.ask ("/tactus/transport/speed", 0.5f, stage.other->number());
    CHECK (stage.puppet.said == "plays 1, to -1.000000, at 0.500000");
    stage.puppet.said.clear();
    for (const auto* address : { "/tactus/transport/seek", "/tactus/transport/speed", "/tactus/transport/back" })
        CHECK (stage.ask (address, -1.0f, stage.other->number()).getAddressPattern().toString() == "/tactus/error");
    CHECK (stage.puppet.said.empty());
    const auto refused = stage.ask ("/tactus/start", stage.other->number());
    CHECK (refused[2].getString() == "osc/start");
}

TEST_CASE ("a hit is passed on with its speed, and a bad one is refused", "[osc]")
{
    Stage s;
    CHECK (s.ask ("/tactus/hit", String ("ring.hit"), 0.5f, s.other->number()).getAddressPattern().toString() == "/tactus/done");
    CHECK (s.puppet.said == "ring.hit hit at 0.500000");
    s.send ("/tactus/hit", String ("ring.hit"), 2);
    CHECK (s.puppet.said == "ring.hit hit at 2.000000");
    const auto refused = s.ask ("/tactus/hit", String ("rang.hit"), 1.0f, s.other->number());
    CHECK (refused[2].getString() == "hit/unknown");
    s.puppet.said.clear();
    CHECK (s.ask ("/tactus/hit", String ("ring.hit"), String ("fast"), s.other->number())[2].getString() == "osc/arguments");
    CHECK (s.ask ("/tactus/hit", 1, 1, s.other->number())[2].getString() == "osc/arguments");
    CHECK (s.puppet.said.empty());
}

TEST_CASE ("with a real device, nothing over OSC raises a force without the token, and every stop works without it", "[osc][safety]")
{
    Stage stage;
    stage.puppet.drives_device = true;
    const auto mu = String ("drag.mu"), ring = String ("ring.hit");
    const auto asks = [&] (const char* address, auto... arguments) { return text (stage.ask (address, arguments..., stage.me()), 2); };
    const auto refuses = [&] {
        CHECK (asks ("/tactus/param", mu, 0.3f) == "osc/token");
        CHECK (asks ("/tactus/control", String ("roughness"), 0.3f) == "osc/token");
        CHECK (asks ("/tactus/hit", ring, 0.3f) == "osc/token");
        CHECK (asks ("/tactus/transport/play", 1) == "osc/token");
        CHECK (asks ("/tactus/start") == "osc/token");
        CHECK (asks ("/tactus/rearm") == "osc/rearm");
        for (const auto& cause : tactus::host::force_causes)   // all that there are, also those that are added later
        {
            if (! cause.event.starts_with ("`/")) continue;
            auto address = std::string (cause.event.substr (1, cause.event.size() - 2));
            if (address.ends_with ('/')) address += "seek";
            INFO (address);
            const auto* to = address.c_str();
            const auto id = address.starts_with ("/tactus/transport/")                 ? asks (to, 1)
                            : address == "/tactus/start" || address == "/tactus/rearm" ? asks (to)
                                                                                       : asks (to, mu, 0.3f);
            CHECK ((id == "osc/token" || id == "osc/rearm"));
        }
        CHECK (stage.puppet.said.empty());
    };
    refuses();
    CHECK (asks ("/tactus/hello", String ("a1b2c4")) == "osc/token");
    refuses();
    for (const auto* stop : { "/tactus/stop", "/tactus/emergency" })
        CHECK (text (stage.ask (stop, stage.me()), 0) == stop);
    CHECK ((stage.puppet.stopped && stage.puppet.emergency));
    CHECK (text (stage.ask ("/tactus/status", stage.me()), 0) == "Puppet");

    CHECK (text (stage.ask ("/tactus/hello", String ("a1b2c3"), stage.me()), 0) == "/tactus/hello");
    CHECK (text (stage.ask ("/tactus/param", mu, 0.3f, stage.me()), 0) == "/tactus/param");
    CHECK (text (stage.ask ("/tactus/hit", ring, 0.3f, stage.me()), 0) == "/tactus/hit");
    stage.puppet.said.clear();

    const auto stranger = std::move (*OscPort::open (0));   // another socket of the same machine
    stranger->send (stage.port->number(), OSCMessage ("/tactus/param", mu, 0.9f, stranger->number()));
    std::optional<OSCMessage> answer;
    while (! answer)
    {
        stage.control.poll (stage.now);
        answer = stranger->next (5ms);
    }
    CHECK (text (*answer, 2) == "osc/token");
    CHECK (stage.puppet.said.empty());

    stage.now += 59s;
    CHECK (text (stage.ask ("/tactus/param", mu, 0.3f, stage.me()), 0) == "/tactus/param");
    stage.now += 61s;
    CHECK (asks ("/tactus/param", mu, 0.3f) == "osc/token");
    stage.ask ("/tactus/hello", String ("a1b2c3"), stage.me());
    stage.ask ("/tactus/hello", stage.me());   // goes
    stage.puppet.said.clear();
    refuses();
}

TEST_CASE ("the token of a run is in a file that only this user can read, and goes with the run", "[osc][safety]")
{
    const TemporaryFolder folder;
    const char* before = std::getenv ("XDG_RUNTIME_DIR");
    const std::string kept = before != nullptr ? before : "";
    setenv ("XDG_RUNTIME_DIR", folder.path().string().c_str(), 1);
    {
        const TokenFile file { 7770, "a1b2c3" };
        CHECK (TokenFile::read (7770) == "a1b2c3");
        CHECK (TokenFile::read (7771).empty());
        using std::filesystem::perms;
        CHECK (std::filesystem::status (folder / "tactus/osc-7770").permissions() == (perms::owner_read | perms::owner_write));
        CHECK (std::filesystem::status (folder / "tactus").permissions() == perms::owner_all);
    }
    CHECK (TokenFile::read (7770).empty());
    before != nullptr ? setenv ("XDG_RUNTIME_DIR", kept.c_str(), 1) : unsetenv ("XDG_RUNTIME_DIR");
}
