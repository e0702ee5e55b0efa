// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/wait_for.hpp"

#include "support/waiting.hpp"

#include <host/app/run/osc_server.hpp>

#include <catch2/catch.hpp>

#include <random>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using juce::OSCMessage;
using namespace std::chrono_literals;

namespace
{
/// The run of a window with an OSC server, and a client.
struct Rig
{
    explicit Rig (const char* preset) : rig (CanvasRig::preset (preset)) {}

    CanvasRig rig;
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    LiveRun& live_run { playback.run() };
    bool asks = false;   // the window waits for an answer
    OscServer server { std::move (*OscPort::open (0)), playback, rig.document, [this] { return asks; } };
    std::unique_ptr<OscPort> other = std::move (*OscPort::open (0));

    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually (2ms, [&] {
            live_run.poll();
            server.poll();
            return isSo();
        });
    }

    template <typename... Args>
    OSCMessage ask (const char* address, Args... args)
    {
        other->send (server.port(), OSCMessage (address, args...));
        std::optional<OSCMessage> answer;
        REQUIRE (until ([&] { return answer || (answer = other->next()); }));
        return *answer;
    }

    std::string text (const OSCMessage& m, int i) { return m.size() > i && m[i].isString() ? m[i].getString().toStdString() : std::string(); }
    int me() const { return other->number(); }
};

bool isError (const OSCMessage& m) { return m.getAddressPattern().toString() == "/tactus/error"; }
}   // namespace

TEST_CASE ("values set over OSC are felt, appear in the window, and are one undo step", "[app][osc]")
{
    Rig r { "dry_wood" };
    CHECK (r.text (r.ask ("/tactus/param", juce::String ("drag.mu"), 0.3f, r.me()), 2) == "run/stopped");
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.live_run.isRunning(); }));

    const auto before = r.rig.document.history().position();
    CHECK_FALSE (isError (r.ask ("/tactus/param", juce::String ("board.stiffness"), juce::String ("1.5 N/mm"), r.me())));
    for (int i = 0; i <= 10; ++i)
        r.ask ("/tactus/control", juce::String ("roughness"), 0.1f * static_cast<float> (i), r.me());
    CHECK (r.rig.document.history().position() == before + 1);
    CHECK (r.rig.document.graph().root.find ("board")->params.at ("stiffness") == Json ("1.5 N/mm"));
    CHECK (r.rig.document.graph().controls.front().value == Approx (1.0));
    CHECK (r.live_run.messages().empty());
    r.rig.document.undo();
    CHECK (r.rig.document.graph().controls.front().value == Approx (0.5));

    const auto here = r.rig.document.history().position();
    CHECK (r.text (r.ask ("/tactus/param", juce::String ("drag.nu"), 0.3f, r.me()), 2) == "param/unknown");
    CHECK (r.text (r.ask ("/tactus/param", juce::String ("drag.mu"), juce::String ("3 mm"), r.me()), 2) == "param/unit");
    CHECK (r.rig.document.history().position() == here);

    r.other->send (r.server.port(), OSCMessage ("/tactus/stop"));
    CHECK (r.until ([&] { return ! r.live_run.isRunning(); }));
    CHECK_FALSE (isError (r.ask ("/tactus/start", r.me())));
    CHECK (r.until ([&] { return r.live_run.isRunning(); }));
}

TEST_CASE ("a message starts nothing that a person has stopped, or that nobody has started", "[app][osc][safety]")
{
    Rig r { "dry_wood" };
    const auto isRefused = [&] { return r.text (r.ask ("/tactus/start", r.me()), 2) == "run/stopped_by_person" && ! r.live_run.isWanted(); };
    CHECK (isRefused());   // as in safe mode, and after Recover without running
    r.playback.preview (r.rig.document.graph());
    REQUIRE (r.until ([&] { return r.playback.current().isRunning(); }));
    r.playback.endPreview();
    CHECK (isRefused());

    const auto byKey = [&] { r.playback.stop(); };
    const auto byPress = [&] {
        r.playback.stopSwitch().stop (By::person);
        r.playback.poll();
    };
    const auto byClosing = [&] { r.live_run.stop(); };   // another graph is opened, and does not run
    for (const auto& stop : { std::function<void()> (byKey), std::function<void()> (byPress), std::function<void()> (byClosing) })
    {
        r.playback.start ({});
        REQUIRE (r.until ([&] { return r.live_run.isRunning(); }));
        stop();
        CHECK (isRefused());
        r.ask ("/tactus/stop", r.me());   // a program that stops it again gains nothing
        CHECK (isRefused());
        REQUIRE (r.until ([&] { return ! r.live_run.isRunning(); }));
        CHECK (isRefused());
    }
}

TEST_CASE ("once the session binds a device, messages need the token of the run, and still start nothing that a person has stopped", "[app][osc][safety]")
{
    Rig r { "dry_wood" };
    const auto set = [&] { return r.ask ("/tactus/param", juce::String ("drag.mu"), 0.3f, r.me()); };
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.live_run.isRunning(); }));
    CHECK_FALSE (isError (set()));   // a simulated tool

    REQUIRE (r.setup.edit ([] (DeviceSession& s) { s.bind ("stylus", { { "driver", "hid" }, { "profile", "tactus_board" } }); }));
    REQUIRE (r.until ([&] { return r.live_run.isRunning() && r.live_run.drivesDevice(); }));
    CHECK (r.text (set(), 2) == "osc/token");
    r.playback.stop (By::program);
    REQUIRE (r.until ([&] { return ! r.live_run.isRunning(); }));
    CHECK (r.text (r.ask ("/tactus/start", r.me()), 2) == "osc/token");

    const juce::String token (TokenFile::read (r.server.port()));
    CHECK_FALSE (isError (r.ask ("/tactus/hello", token, r.me())));
    CHECK_FALSE (isError (r.ask ("/tactus/start", r.me())));
    REQUIRE (r.until ([&] { return r.live_run.isRunning(); }));
    CHECK_FALSE (isError (set()));
    CHECK (r.text (r.ask ("/tactus/rearm", token, r.me()), 2) == "osc/rearm");   // the window has a button for that
    r.playback.stop();
    CHECK (r.text (r.ask ("/tactus/start", r.me()), 2) == "run/stopped_by_person");

    r.ask ("/tactus/hello", r.me());
    r.playback.start (LiveRun::Hand::pointer());   // the device moves nothing
    REQUIRE (r.until ([&] { return r.live_run.isRunning() && ! r.live_run.drivesDevice(); }));
    CHECK_FALSE (isError (set()));
}

TEST_CASE ("a message that arrives is reported on the main thread, so that a window at rest answers it", "[app][osc]")
{
    Rig r { "dry_wood" };
    bool is_reported = false;
    r.server.onMessage = [&] { is_reported = juce::MessageManager::existsAndIsCurrentThread(); };
    r.other->send (r.server.port(), OSCMessage ("/tactus/status", r.me()));
    CHECK (host::test::waitFor ([&] { return is_reported; }, 1));
}

TEST_CASE ("an OSC client can probe a port of the window, even after an edit, until the port is removed", "[app][osc]")
{
    Rig r { "dry_wood" };
    r.live_run.start ({});
    const auto done = r.ask ("/tactus/probe", juce::String ("drag.force"), r.me(), 500.0f, 30.0f);
    REQUIRE_FALSE (isError (done));
    CHECK (done.size() == 6);
    CHECK (r.text (done, 3) == "drag.force.x");
    const auto next = [&] {
        std::optional<OSCMessage> value;
        REQUIRE (r.until ([&] { return value || (value = r.other->next()); }));
        return *value;
    };
    const auto first = next();
    CHECK (first.getAddressPattern().toString() == "/tactus/value");
    CHECK (first.size() == 5);
    CHECK (next()[1].getInt32() > first[1].getInt32());

    r.rig.document.perform (graph::SetParam { "", "drag", "mu", Json (0.3) });
    CHECK (next().getAddressPattern().toString() == "/tactus/value");
    r.rig.document.perform (graph::RemoveNode { "", "drag" });
    std::optional<OSCMessage> ended;
    CHECK (r.until ([&] {
        while (auto m = r.other->next())
            if (isError (*m)) ended = m;
        return ended.has_value();
    }));
}

TEST_CASE ("an OSC client can wait for an edge in the window", "[app][osc]")
{
    Rig r { "dry_wood" };
    r.live_run.start ({});
    const juce::String port = "drag.force", watched = "board.depth", edge = "rising";
    REQUIRE_FALSE (isError (r.ask ("/tactus/trigger", port, r.me(), watched, 1e-4f, edge, 10, 20, 30.0f)));
    std::size_t numbers = 0;
    CHECK (r.until ([&] {
        while (auto m = r.other->next())
            if (m->getAddressPattern().toString() == "/tactus/capture") numbers += static_cast<std::size_t> (m->size()) - 4;
        return numbers == 31 * 3;
    }));
    CHECK (isError (r.ask ("/tactus/trigger", juce::String ("drag.force"), r.me(), juce::String ("drag.force"), 0.5f)));
    CHECK_FALSE (r.live_run.isCapturing());
}

TEST_CASE ("random packets do not harm the window", "[app][osc]")
{
    Rig r { "dry_wood" };
    r.live_run.start ({});
    REQUIRE (r.until ([&] { return r.live_run.isRunning(); }));
    std::mt19937 dice { 5 };
    juce::DatagramSocket socket;
    for (int i = 0; i < 20000; ++i)
    {
        std::string bytes (dice() % 200, ' ');
        for (auto& b : bytes)
            b = static_cast<char> (dice());
        if (i % 3 == 0) bytes.insert (0, std::string ("/tactus/param\0\0\0,sf\0", 20));
        if (i % 7 == 0) bytes.insert (0, std::string ("#bundle\0\0\0\0\0\0\0\0\1", 16));
        socket.write ("127.0.0.1", r.server.port(), bytes.data(), static_cast<int> (bytes.size()));
        if (i % 500 == 0) r.server.poll();
    }
    std::optional<OSCMessage> status;   // packets that do not fit into the queue are dropped
    CHECK (r.until ([&] {
        if (! status) r.other->send (r.server.port(), OSCMessage ("/tactus/status", r.me()));
        return status || (status = r.other->next());
    }));
    CHECK (r.text (*status, 0) == "Dry wood");
    CHECK (r.live_run.isRunning());
    CHECK (r.live_run.messages().empty());
}

TEST_CASE ("an emergency stop over OSC removes the force while the message thread is stuck", "[app][osc][safety]")
{
    Rig r { "dry_wood" };
    r.live_run.start ({});
    REQUIRE (r.until ([&] { return r.live_run.status() && r.live_run.status()->force > 0.0; }));

    r.other->send (r.server.port(), OSCMessage ("/tactus/emergency"));
    const auto isLatched = [&] { return r.live_run.isStoppedForGood(); };   // reads only what the tick thread has published
    REQUIRE (tactus::test::eventually (isLatched));
    r.live_run.rearm();   // the message thread has not noticed the stop yet, so rearm() must have no effect
    CHECK (tactus::test::stays (50ms, isLatched));
}

TEST_CASE ("nothing starts over OSC while the window asks a question", "[app][osc][safety]")
{
    Rig r { "dry_wood" };
    r.playback.start ({});
    r.playback.stop (By::program);
    r.asks = true;
    CHECK (isError (r.ask ("/tactus/start", r.me())));
    CHECK_FALSE (r.live_run.isWanted());
    r.asks = false;
    CHECK_FALSE (isError (r.ask ("/tactus/start", r.me())));
    CHECK (r.live_run.isWanted());
}

TEST_CASE ("a start over OSC ends no latched stop", "[app][osc][safety]")
{
    Rig r { "dry_wood" };
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.live_run.status() && r.live_run.status()->force > 0.0; }));
    r.live_run.emergencyStop (By::program);
    REQUIRE (r.until ([&] { return r.live_run.isStoppedForGood(); }));
    CHECK (isError (r.ask ("/tactus/start", r.me())));
    CHECK (r.live_run.isStoppedForGood());
    REQUIRE (r.until ([&] { return r.live_run.canRearm(); }));
    CHECK (isError (r.ask ("/tactus/start", r.me())));
    CHECK (r.live_run.isStoppedForGood());
}
