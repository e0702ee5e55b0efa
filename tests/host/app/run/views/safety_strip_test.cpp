// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/seen_text.hpp"

#include "support/waiting.hpp"

#include <host/app/run/views/safety_strip.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <map>
#include <optional>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;

namespace
{
juce::Button* buttonCalled (juce::Component& in, const juce::String& text)
{
    for (auto* child : in.getChildren())
        if (auto* button = dynamic_cast<juce::Button*> (child); button != nullptr && button->isVisible() && button->getButtonText() == text) return button;
    return nullptr;
}

/// A strip of 1280 units, and what it shows and controls.
struct StripRig
{
    Sound sound;
    DeviceSetup setup;
    Playback playback;
    Look look;
    SafetyStrip strip { playback };

    explicit StripRig (CanvasRig& rig) : playback (rig.document, catalogue(), sound, setup, [] {})
    {
        strip.setLookAndFeel (&look);
        strip.setSize (1280, SafetyStrip::height);
    }
    ~StripRig() { strip.setLookAndFeel (nullptr); }
};
}   // namespace

TEST_CASE ("REARM never appears in the place of STOP", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    StripRig seen { rig };
    auto& playback = seen.playback;
    auto& strip = seen.strip;
    auto& run = playback.run();
    const auto until = [&] (auto isSo) {
        return tactus::test::eventually (std::chrono::milliseconds (5), [&] {
            run.poll();
            strip.refresh();
            return isSo();
        });
    };
    strip.refresh();
    REQUIRE (buttonCalled (strip, "START"));
    run.start ({});
    REQUIRE (until ([&] { return buttonCalled (strip, "STOP") != nullptr; }));
    CHECK (buttonCalled (strip, "REARM") == nullptr);
    const auto place = buttonCalled (strip, "STOP")->getBounds();

    run.emergencyStop();
    REQUIRE (until ([&] { return buttonCalled (strip, "REARM") != nullptr; }));
    strip.setSize (512, SafetyStrip::height);   // as at 1024 pixels and 200 %: the reason comes before the rate
    const auto texts = readTexts (strip);
    const auto isSeen = [&] (const juce::String& text) { return std::ranges::any_of (texts, [&] (const SeenText& t) { return t.text.contains (text); }); };
    CHECK (isSeen ("emergency"));
    CHECK_FALSE (isSeen ("running"));
    strip.setSize (1280, SafetyStrip::height);
    REQUIRE (buttonCalled (strip, "STOP"));
    CHECK (buttonCalled (strip, "STOP")->getBounds() == place);
    CHECK_FALSE (buttonCalled (strip, "REARM")->getBounds().intersects (place));

    CHECK_FALSE (buttonCalled (strip, "REARM")->isEnabled());   // a double click on STOP must not rearm
    buttonCalled (strip, "REARM")->onClick();
    CHECK (run.isStoppedForGood());
    REQUIRE (until ([&] { return buttonCalled (strip, "REARM")->isEnabled(); }));
    buttonCalled (strip, "REARM")->onClick();
    CHECK (until ([&] { return buttonCalled (strip, "REARM") == nullptr && run.isRunning(); }));
    CHECK (until ([&] { return strip.guardText() == "guard ready" && ! strip.isAlarmed(); }));
    playback.stop();
    CHECK (until ([&] { return ! run.isRunning() && strip.text() == "stopped"; }));
    CHECK (strip.guardText() == "");
    CHECK_FALSE (strip.isAlarmed());
    playback.restart();
    REQUIRE (until ([&] { return run.isRunning() && run.status() && run.status()->ticks > 100; }));
    run.emergencyStop();
    run.startOther ({});   // as another graph does that is opened now
    CHECK (until ([&] { return run.isRunning() && strip.guardText().contains ("stopped before this graph began; REARM"); }));
    buttonCalled (strip, "STOP")->onClick();
    CHECK (until ([&] { return ! run.isRunning(); }));
}

TEST_CASE ("the strip says in words that a simulated tool without a guard has had a force beyond that of any motor", "[app][run]")
{
    CanvasRig rig { readGraph (R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, "devices": { "tip": { "driver": "sim" } },
        "nodes": { "hand": { "type": "device.position", "role": "tip" }, "push": { "type": "signal.constant", "params": { "value": "1e9 N" } },
                   "motor": { "type": "device.force", "role": "tip" } },
        "wires": [ "push.out -> motor.force.z" ] })")
                        .graph };
    StripRig seen { rig };
    seen.playback.run().start ({});
    const auto isSeen = [&] {
        seen.playback.run().poll();
        seen.strip.refresh();
        return seen.strip.forceText().endsWith ("peak over 1000 kN");
    };
    CHECK (tactus::test::eventually (std::chrono::milliseconds (5), isSeen));
    seen.playback.stop();
}

TEST_CASE ("while an edit has errors, the strip says that the last valid version runs, and a click on that shows the problems", "[app][run]")
{
    CanvasRig rig { readGraph (R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000, "devices": { "tip": { "driver": "gesture", "path": "circle" } },
        "nodes": { "hand": { "type": "device.position", "role": "tip" }, "a": { "type": "signal.slew" }, "b": { "type": "signal.slew" } },
        "wires": [ "a.out -> b.in" ] })")
                        .graph };
    StripRig seen { rig };
    auto& playback = seen.playback;
    auto& strip = seen.strip;
    int shown = 0;
    strip.onProblems = [&] { ++shown; };
    const auto refresh = [&] {
        playback.poll();
        strip.refresh();
        juce::Image picture (juce::Image::RGB, strip.getWidth(), strip.getHeight(), true);
        juce::Graphics g (picture);
        strip.paintEntireComponent (g, false);
    };
    const auto click = [&] {
        const auto now = juce::Time::getCurrentTime();
        const juce::Point<float> at { 60.0f, 0.5f * SafetyStrip::height };
        strip.mouseUp ({ juce::Desktop::getInstance().getMainMouseSource(), at, {}, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, &strip, &strip, now, at, now, 1, false });
    };
    playback.run().start ({});
    REQUIRE (tactus::test::eventually (std::chrono::milliseconds (5), [&] {
        refresh();
        return playback.run().isRunning();
    }));
    refresh();
    click();
    CHECK (shown == 0);

    graph::Wire back;   // closes a loop without a delay
    back.from = { "b", "out" };
    back.to = { "a", "in" };
    REQUIRE (rig.document.perform (graph::AddWire { "", back }));
    refresh();
    REQUIRE (hasErrors (playback.run().messages()));
    CHECK (playback.run().isRunning());
    CHECK (strip.text().contains ("still running the last valid version"));
    click();
    CHECK (shown == 1);
}

TEST_CASE ("a graph with errors that was started says that it waits, and STOP ends the waiting", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    graph::Wire back;   // closes a loop without a delay
    back.from = { "grain_felt", "out" };
    back.to = { "grain_felt", "in" };
    REQUIRE (rig.document.perform (graph::AddWire { "", back }));
    StripRig seen { rig };
    auto& playback = seen.playback;
    auto& strip = seen.strip;
    const auto runs = [&] {
        playback.poll();
        strip.refresh();
        return playback.run().isRunning();
    };
    const auto rests = [&] { return tactus::test::stays (std::chrono::seconds (1), [&] { return ! runs(); }); };
    playback.run().start ({});
    CHECK (rests());
    CHECK (strip.text().startsWith ("cannot run: "));   // and what is wrong
    CHECK (strip.text().contains ("loop"));
    CHECK (strip.text().endsWith (" (starts once this is solved)"));
    REQUIRE (buttonCalled (strip, "STOP"));
    CHECK_FALSE (strip.stopPlace().isEmpty());
    SECTION ("it starts when they are")
    {
        rig.document.undo();
        CHECK (tactus::test::eventually (runs));
    }
    SECTION ("after STOP it does not")
    {
        buttonCalled (strip, "STOP")->onClick();
        strip.refresh();
        CHECK (strip.text().startsWith ("cannot run: "));
        CHECK_FALSE (strip.text().contains ("starts once"));
        CHECK (buttonCalled (strip, "START"));
        rig.document.undo();
        CHECK (rests());
        CHECK (strip.text() == "stopped");
    }
}

TEST_CASE ("a graph with a node of an unknown type is opened as one that cannot run, also over a graph that runs", "[app][run][safety]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    StripRig seen { rig };
    auto& playback = seen.playback;
    auto& strip = seen.strip;
    const auto runs = [&] {
        playback.poll();
        strip.refresh();
        CHECK_FALSE (strip.text().contains ("still running"));
        return playback.run().isRunning();
    };
    playback.run().start ({});
    REQUIRE (tactus::test::eventually (runs));
    auto strange = readGraph (R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000, "devices": { "tip": { "driver": "gesture", "path": "circle" } },
        "nodes": { "hand": { "type": "device.position", "role": "tip" }, "odd": { "type": "lab.strange" } } })");
    playback.stop();   // as when a file is opened
    rig.document.open (std::move (strange.graph), {}, "open");
    playback.startOther ({});
    REQUIRE (tactus::test::eventually ([&] { return ! runs(); }));
    CHECK (tactus::test::stays (std::chrono::milliseconds (300), [&] { return ! runs(); }));
    CHECK (strip.text().startsWith ("cannot run: "));
    CHECK (strip.text().contains ("lab.strange"));
}

TEST_CASE ("the strip counts the delay of the device, and says so if a device could not be opened", "[app][run]")
{
    auto wood = CanvasRig::preset ("dry_wood");
    REQUIRE (wood.rate_hz == 4000.0);
    const auto says = [] (graph::Graph g, const juce::String& part, const std::optional<graph::SetParam>& edit = {}) {
        CanvasRig rig { std::move (g) };
        StripRig seen { rig };
        seen.strip.setSize (1920, SafetyStrip::height);
        seen.playback.start ({});
        const auto is_said = [&] {
            seen.playback.poll();
            seen.strip.refresh();
            juce::StringArray all { seen.strip.text() };
            for (const auto& t : readTexts (seen.strip))
                all.add (t.text);
            return all.joinIntoString ("|").contains (part);
        };
        bool is_kept = tactus::test::eventually (std::chrono::milliseconds (5), is_said);
        if (edit) is_kept = is_kept && rig.document.perform (*edit) && is_said();
        seen.playback.run().letGo();
        return is_kept;
    };
    auto& device = wood.devices.front().second;
    device["damping"] = 1.0;
    CHECK (says (wood, "undamped walls passive up to 8.0 N/mm"));   // 2 B / T
    auto late = wood;                                               // one of several paths
    std::ranges::find (late.root.wires, "motor", [] (const graph::Wire& w) { return w.to.node; })->delay = 2;
    CHECK (says (late, "delay 0 to 2 ticks"));
    CHECK (says (late, "undamped walls passive up to 1.6 N/mm"));
    device["delay"] = 3;
    CHECK (says (wood, "delay 3 ticks"));
    CHECK (says (wood, "undamped walls passive up to 1.1 N/mm"));   // 2 B / ((2 d + 1) T)
    device["mass"] = -3;
    CHECK (says (wood, "runs without a device: ", graph::SetParam { "", "grain", "spatial_frequency", Json ("1000 1/m") }));
}

TEST_CASE ("the strip of a graph that is stopped has no delay and no stiffness, since an edit may change its rate", "[app][words]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    StripRig seen { rig };
    seen.strip.setSize (1920, SafetyStrip::height);
    const auto says = [&seen] (const juce::String& part) {
        seen.playback.poll();
        seen.strip.refresh();
        return std::ranges::any_of (readTexts (seen.strip), [&] (const auto& t) { return t.text.contains (part); });
    };
    seen.playback.start ({});
    REQUIRE (tactus::test::eventually (std::chrono::milliseconds (5), [&] { return says ("undamped walls passive up to"); }));
    seen.playback.stop();
    REQUIRE (tactus::test::eventually (std::chrono::milliseconds (5), [&] { return ! seen.playback.run().isRunning(); }));
    CHECK_FALSE (says ("undamped walls passive up to"));
    CHECK_FALSE (says ("delay"));
    seen.playback.run().letGo();
}

TEST_CASE ("each part of the strip says what it means", "[app][words]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    StripRig seen { rig };
    auto& strip = seen.strip;
    strip.setSize (1920, SafetyStrip::height);
    seen.playback.start ({});
    REQUIRE (tactus::test::eventually (std::chrono::milliseconds (5), [&] {
        seen.playback.poll();
        strip.refresh();
        return seen.playback.run().delay() && strip.guardText().contains ("ready");
    }));
    std::map<juce::String, juce::String> meanings;
    for (const auto& t : readTexts (strip))
        if (const auto meaning = strip.tooltipAt (t.place.getCentre().toInt()); meaning.isNotEmpty()) meanings[t.text] = meaning;
    const auto says = [&] (const juce::String& part, const juce::String& word) {
        for (const auto& [text, meaning] : meanings)
            if (text.startsWith (part) && meaning.contains (word)) return true;
        return false;
    };
    CHECK (says ("running", "ticks per second"));
    CHECK (says ("guard ready", "between the graph and the motors"));
    CHECK (says ("late ticks", "not finished in time"));
    CHECK (says ("delay", "from a movement of the hand"));
    CHECK (says ("undamped walls passive up to", "largest stiffness"));
    CHECK (strip.tooltipAt ({ -5, -5 }).isEmpty());
    seen.playback.run().letGo();
}

TEST_CASE ("START and STOP say what they do, and which key does it, too", "[app][words]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    StripRig seen { rig };
    const auto comesToSay = [&] (const char* text, const char* key) {
        return tactus::test::eventually (std::chrono::milliseconds (5), [&] {
            seen.playback.poll();
            seen.strip.refresh();
            auto* button = buttonCalled (seen.strip, text);
            return button != nullptr && button->getTooltip().contains (key);
        });
    };
    CHECK (comesToSay ("START", "F5"));
    seen.playback.start ({});
    CHECK (comesToSay ("STOP", "Esc"));
    seen.playback.stop();
    CHECK (comesToSay ("START", "F5"));
    seen.playback.run().letGo();
}
