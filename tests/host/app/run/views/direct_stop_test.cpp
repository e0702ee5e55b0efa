// SPDX-License-Identifier: GPL-3.0-or-later
// The keys and the STOP button of the window stop the forces while the message thread is busy, as docs/safety.md claims.
//
// In the process with the screen, the thread of the test is the message thread: while it waits for xdotool or for the force, it handles no message.

#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/screen.hpp"
#include "host/app/support/wait_for.hpp"

#include "support/waiting.hpp"

#include <host/app/run/views/direct_stop.hpp>
#include <host/app/run/views/safety_strip.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <set>
#include <string>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;
using tactus::test::eventually;
using tactus::test::stays;
using tactus::test::Stopwatch;
using namespace std::chrono_literals;

namespace
{
/// A window with only the safety strip, and a run that pushes with 2 N.
struct Window final : private Application, public juce::Component
{
    Window() : rig (graph())
    {
        strip.setLookAndFeel (&look);
        strip.setBounds (30, 50, 900, SafetyStrip::height);
        addAndMakeVisible (strip);
        setBounds (100, 100, 1000, 300);
        setOpaque (true);
        setWantsKeyboardFocus (true);
        addToDesktop (0);
        setVisible (true);
    }
    ~Window() override { strip.setLookAndFeel (nullptr); }

    static graph::Graph graph()
    {
        return readGraph (R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000, "devices": { "tip": { "driver": "gesture", "path": "circle" } },
          "nodes": { "push": { "type": "signal.constant", "params": { "value": 2 } }, "motor": { "type": "device.force", "role": "tip" } },
          "wires": [ "push.out -> motor.force.x" ] })")
            .graph;
    }

    void paint (juce::Graphics& g) override { g.fillAll (juce::Colours::black); }

    /// Handles messages for 10 ms, then does what the timer of the real window does.
    void poll()
    {
        host::test::handleMessages (10);
        playback.poll();
        strip.refresh();
        if (const auto why = direct.follow (strip, strip.stopPlace())) FAIL (why->text);
    }

    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually ({}, [&] {
            poll();
            return isSo();
        });
    }

    LiveRun& run() { return playback.run(); }
    double force() { return run().status() ? run().status()->force : 0.0; }

    /// Starts the run, and waits until the force is 2 N and the window is in front, with the keyboard focus.
    void start()
    {
        run().start ({});
        REQUIRE (until ([&] { return force() == 2.0; }));
        toFront (true);
        const Stopwatch watch;
        REQUIRE (until ([&] { return watch.hasRun (200ms) && hasKeyboardFocus (true); }));
    }

    std::string stopPlace()
    {
        const auto place = strip.getScreenBounds().withTrimmedLeft (strip.getWidth() - 60).getCentre();
        return std::to_string (place.x) + " " + std::to_string (place.y);
    }

    CanvasRig rig;
    Look look;
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    SafetyStrip strip { playback };
    DirectStop direct { playback.stopSwitch() };
};
}   // namespace

TEST_CASE ("Shift+Esc removes the force while the message thread is stuck, and only a later REARM brings it back", "[app][run][safety]")
{
    onScreen ("on a screen: Shift+Esc");
}

TEST_CASE ("on a screen: Shift+Esc", "[.screen]")
{
    Window w;
    w.start();
    xdo ("key a space Return ctrl+s");   // these keys must not stop anything
    REQUIRE (stays (100ms, [&] { return w.force() == 2.0; }));

    xdo ("key shift+Escape");
    const Stopwatch watch;
    REQUIRE (eventually ([&] { return w.force() == 0.0; }));
    std::printf ("zero force at most %.1f ms after xdotool ended\n", 1e3 * watch.s());
    CHECK (w.run().isRunning());          // the graph keeps running
    CHECK (w.run().isStoppedForGood());   // latched
    w.run().rearm();                      // a REARM that was clicked before the stop, but is handled after it
    CHECK (stays (100ms, [&] { return w.force() == 0.0; }));
    CHECK (stays (2s, [&] { return w.force() == 0.0; }));   // the message thread is still stuck

    w.poll();
    CHECK_FALSE (w.run().canRearm());   // the pause before a REARM counts from when the window notices the stop
    REQUIRE (w.until ([&] { return w.run().canRearm(); }));
    CHECK (w.run().isStoppedForGood());
    w.run().rearm();
    CHECK (w.until ([&] { return w.force() == 2.0; }));
}

TEST_CASE ("a click on STOP ends a run while the message thread is stuck, and does not start it again", "[app][run][safety]")
{
    onScreen ("on a screen: a click on STOP");
}

TEST_CASE ("on a screen: a click on STOP", "[.screen]")
{
    Window w;
    w.start();
    xdo ("mousemove 200 300 click 1");                         // elsewhere in the window
    xdo ("mousemove " + w.stopPlace() + " click 4 click 5");   // the mouse wheel, over STOP
    REQUIRE (stays (100ms, [&] { return w.force() == 2.0; }));

    xdo ("click --repeat 3 --delay 30 1");
    REQUIRE (eventually ([&] { return ! w.run().isRunning(); }));
    CHECK (w.run().isWanted());   // the window has not noticed the stop yet
    tactus::test::letPass (1s);
    const Stopwatch shown;
    for (int i = 0; i < 10; ++i)
        w.poll();
    CHECK_FALSE (w.run().isWanted());
    CHECK_FALSE (w.run().isRunning());

    xdo ("click 1");   // the button has been START for less than a second
    tactus::test::letPass (50ms);
    w.poll();
    if (! shown.hasRun (950ms)) CHECK_FALSE (w.run().isWanted());   // otherwise the machine was too slow for this test
    const Stopwatch later;
    w.until ([&] { return later.hasRun (1200ms); });
    if (! w.run().isWanted()) xdo ("click 1");
    CHECK (w.until ([&] { return w.force() == 2.0; }));

    xdo ("key Escape");
    CHECK (eventually ([&] { return ! w.run().isRunning(); }));
}

TEST_CASE ("a click on another window that covers STOP does not stop", "[app][run]")
{
    onScreen ("on a screen: a covered STOP");
}

TEST_CASE ("on a screen: a covered STOP", "[.screen]")
{
    Window w;
    w.start();
    juce::Component cover;
    cover.setBounds (w.getBounds());
    cover.addToDesktop (0);
    cover.setVisible (true);
    cover.toFront (false);
    for (int i = 0; i < 20; ++i)
        w.poll();
    xdo ("mousemove " + w.stopPlace() + " click 1");
    CHECK (stays (200ms, [&] { return w.force() == 2.0; }));
    cover.removeFromDesktop();
    for (int i = 0; i < 20; ++i)
        w.poll();
    xdo ("click 1");
    CHECK (eventually ([&] { return ! w.run().isRunning(); }));
}

TEST_CASE ("Esc stops the forces while a file dialog has the keyboard and the message thread is stuck", "[app][run][safety]")
{
    onScreen ("on a screen: Esc in a dialog");
}

TEST_CASE ("on a screen: Esc in a dialog", "[.screen]")
{
    Window w;
    w.start();
    juce::FileChooser dialog ("Save graph", juce::File::getCurrentWorkingDirectory(), "*.json", false);
    dialog.launchAsync (juce::FileBrowserComponent::saveMode | juce::FileBrowserComponent::canSelectFiles, [] (const juce::FileChooser&) {});
    const auto isInText = [] { return dynamic_cast<juce::TextEditor*> (juce::Component::getCurrentlyFocusedComponent()) != nullptr; };
    const Stopwatch opened;
    REQUIRE (w.until ([&] { return opened.hasRun (500ms) && ! w.hasKeyboardFocus (true); }));
    w.until ([&] { return isInText() || opened.hasRun (1500ms); });

    xdo ("key a space");   // these keys are text
    REQUIRE (stays (100ms, [&] { return w.force() == 2.0; }));
    xdo ("key Escape");
    CHECK (eventually ([&] { return ! w.run().isRunning(); }));
}

TEST_CASE ("on a screen: Esc that closes something", "[.screen]")
{
    Window w;
    w.start();
    w.direct.letEscStop (false);
    xdo ("key Escape");
    CHECK (stays (200ms, [&] { return w.force() == 2.0; }));
    xdo ("key shift+Escape");
    CHECK (eventually ([&] { return w.force() == 0.0; }));
}

TEST_CASE ("Shift+Esc removes the force even while Esc would only close something", "[app][run][safety]")
{
    onScreen ("on a screen: Esc that closes something");
}

namespace
{
std::set<std::string> threads()
{
    std::set<std::string> all;
    for (const auto& t : std::filesystem::directory_iterator ("/proc/self/task"))
        all.insert (t.path().string());
    return all;
}

/// How often a thread has waited for something.
std::string waitsOf (const std::string& thread)
{
    std::ifstream status (thread + "/status");
    for (std::string line; std::getline (status, line);)
        if (line.starts_with ("voluntary_ctxt_switches")) return line;
    return {};
}
}   // namespace

TEST_CASE ("on a screen: a watcher at rest", "[.screen]")
{
    Window w;
    const auto before = threads();
    REQUIRE_FALSE (w.direct.follow (w.strip, w.strip.stopPlace()));
    std::vector<std::string> made;
    std::ranges::set_difference (threads(), before, std::back_inserter (made));
    REQUIRE (made.size() == 1);
    std::string waits;
    CHECK (eventually ([&] {   // once it has begun, it waits, and nothing wakes it
        const auto last = std::exchange (waits, waitsOf (made.front()));
        tactus::test::letPass (200ms);
        return ! waits.empty() && waits == last && w.direct.follow (w.strip, w.strip.stopPlace()) == std::nullopt && waitsOf (made.front()) == waits;
    }));
    w.strip.setBounds (60, 90, 900, SafetyStrip::height);
    w.start();   // what has moved is where it is now
    xdo ("mousemove " + w.stopPlace() + " click 1");
    CHECK (eventually ([&] { return ! w.run().isRunning(); }));
}

TEST_CASE ("nothing wakes the thread that waits for stops but a stop, or a STOP that has moved", "[app][run]")
{
    onScreen ("on a screen: a watcher at rest");
}

TEST_CASE ("a press of the stop switch before a run begins is not lost", "[app][run][safety]")
{
    CanvasRig rig { Window::graph() };
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    const bool is_emergency = GENERATE (false, true);
    is_emergency ? playback.stopSwitch().emergencyStop (By::person) : playback.stopSwitch().stop (By::person);
    playback.restart();   // a click on START, made before the press but handled after it
    CHECK_FALSE (playback.run().isWanted());
    playback.poll();
    CHECK_FALSE (playback.run().isRunning());

    playback.restart();
    CHECK (eventually ([&] { return playback.run().isRunning() && playback.run().status()->force == 2.0; }));
    playback.run().letGo();
}
