// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/compose/banks.hpp>
#include <host/app/layers/layers_panel.hpp>
#include <host/app/run/live_run.hpp>

#include <tactus/file/graph_file.hpp>

#include "host/app/support/seen_text.hpp"
#include "host/app/support/wait_for.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>

using namespace tactus;
using namespace tactus::host;

namespace
{
struct Rig
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    std::unique_ptr<Document> document;
    std::unique_ptr<LiveRun> live_run;
    std::unique_ptr<LayersPanel> panel;

    explicit Rig (const std::string& preset) : Rig (loadGraph (TACTUS_SOURCE_DIR "/graphs/" + preset).graph) {}

    explicit Rig (graph::Graph g)
    {
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        document = std::make_unique<Document> (std::move (g));
        live_run = std::make_unique<LiveRun> (*document, catalogue());
        panel = std::make_unique<LayersPanel> (*document, live_run->traces(), catalogue());
        panel->commandToMix = [this] (const UnmixedSignal& u) { return compose::mixIn (document->graph(), u.sink, u.port, catalogue()); };
        panel->setBounds (0, 0, 900, 232);
        panel->setVisible (true);
    }

    ~Rig()
    {
        panel.reset();
        live_run.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    const graph::Node& mixer() const { return *findMixer (document->graph(), panel->mixers().front()); }
    static void settle() { host::test::settle(); }
    juce::Image picture() { return panel->createComponentSnapshot (panel->getLocalBounds()); }
};

juce::MouseEvent event (juce::Component& c, juce::Point<float> at, juce::Point<float> from, juce::ModifierKeys mods, int clicks = 1)
{
    const auto now = juce::Time::getCurrentTime();
    return { juce::Desktop::getInstance().getMainMouseSource(), at, mods, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, &c, &c, now, from, now, clicks, at != from };
}
}   // namespace

TEST_CASE ("a mixer has a strip for each layer, with its name, source and gain", "[layers]")
{
    Rig rig ("bronze_bell.json");
    REQUIRE (rig.panel->layers() == 3);
    CHECK (rig.panel->layer (0).sourceText() == "blow.resistance");
    CHECK (rig.panel->layer (2).shownGain() == Approx (0.5));
    REQUIRE (rig.panel->mix() != nullptr);
}

TEST_CASE ("+ Clip asks for its file first: without one nothing is added, and with one each tap plays it", "[layers]")
{
    Rig rig ("bronze_bell.json");
    const auto before = writeGraph (rig.document->graph());
    std::function<void (const std::filesystem::path&)> answer;
    rig.panel->onChooseClip = [&] (auto chosen) { answer = std::move (chosen); };
    const auto press = [&] {
        for (auto* child : rig.panel->getChildren())
            if (auto* b = dynamic_cast<juce::Button*> (child); b != nullptr && b->getButtonText() == "+ Clip") b->onClick();
    };
    press();
    REQUIRE (answer);
    CHECK (writeGraph (rig.document->graph()) == before);   // the user may choose none

    answer ("/clips/knock.haptic");
    const auto& nodes = rig.document->graph().root.nodes;
    const auto clip = std::ranges::find (nodes, "signal.clip", &graph::Node::type);
    REQUIRE (clip != nodes.end());
    CHECK (clip->settings["clip"].get<std::string>().ends_with ("/clips/knock.haptic"));
    CHECK_FALSE (clip->params.contains ("repeat"));                                                                            // it does not loop
    CHECK (std::ranges::any_of (rig.document->graph().root.wires, [&] (const auto& w) { return w.to.node == clip->name; }));   // a tap starts it
    CHECK (rig.panel->layers() == 4);
    CHECK (rig.document->history().position() == 1);
}

TEST_CASE ("a fader that is set by a control moves the control, in one undo step", "[layers]")
{
    Rig rig ("bronze_bell.json");
    auto& strip = rig.panel->layer (0);
    CHECK (strip.shownGain() == Approx (0.96));   // 0.6 of the way from 0 to 1.6
    strip.setGain (Json (0.8), false);
    strip.setGain (Json (0.4), true);
    CHECK (rig.document->graph().controls[0].value == Approx (0.25));
    CHECK (strip.shownGain() == Approx (0.4));
    strip.setGain (Json (99), false);
    CHECK (rig.document->graph().controls[0].value == 1.0);
    CHECK (rig.document->history().names().size() == 2);
    CHECK (rig.mixer().params["gain"].dump() == "[1,1,0.5]");
}

TEST_CASE ("M and S show what a control sets, on above 0.5 as in the mixer, and a click moves the control", "[layers]")
{
    const std::string param = GENERATE ("mute", "solo");
    const double at = GENERATE (0.3, 0.55, 1.0), widest = GENERATE (1.0, 0.4);
    INFO (param << " " << at << " of " << widest);
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph;
    std::ranges::find (g.root.nodes, "desk", &graph::Node::name)->params[param] = Json::array ({ 0, 1, 0 });
    graph::Control control;
    control.id = control.name = "hush";
    control.value = at;
    control.to = { { "desk." + param + "[1]", 0.0, widest } };
    g.controls.push_back (control);
    Rig rig (g);
    juce::String hint;
    rig.panel->onHint = [&] (const juce::String& text) { hint = text; };
    juce::Button* button = nullptr;
    for (auto* child : rig.panel->layer (1).getChildren())
        if (auto* b = dynamic_cast<juce::Button*> (child); b != nullptr && b->getButtonText() == (param == "mute" ? "M" : "S")) button = b;
    REQUIRE (button != nullptr);
    const bool was_on = at * widest > 0.5;
    CHECK (button->getToggleState() == was_on);
    button->onClick();
    const bool can = was_on || widest > 0.5;   // some ranges do not reach "on"
    CHECK (button->getToggleState() == (can && ! was_on));
    CHECK (rig.document->graph().controls.back().value == (can ? (was_on ? 0.0 : 1.0) : at));
    CHECK (hint.contains ("hush") == ! can);
    CHECK (rig.mixer().params[param].dump() == "[0,1,0]");
    CHECK (rig.document->history().position() == (can ? 1u : 0u));
}

TEST_CASE ("a priority that is set by a control moves the control", "[layers]")
{
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph;
    graph::Control control;
    control.id = control.name = "rank";
    control.to = { { "desk.priority[1]", 0.0, 10.0 } };
    g.controls.push_back (control);
    Rig rig (g);
    rig.panel->layer (1).setValue ("priority", Json (3), false);
    CHECK (rig.document->graph().controls.back().value == Approx (0.3));
    CHECK (rig.mixer().params["priority"].dump() == "[1,0,0]");
}

TEST_CASE ("dragging a fader sets the gain in one step, Shift makes it fine, and Alt-click resets it", "[layers]")
{
    Rig rig ("bronze_bell.json");
    Fader fader;
    fader.setBounds (0, 0, 36, 116);   // gives a travel of 100 pixels
    std::vector<std::pair<std::optional<double>, bool>> changes;
    fader.onChange = [&] (std::optional<double> v, bool goes_on) { changes.emplace_back (v, goes_on); };
    fader.show (1.0);
    const juce::Point<float> from { 18.0f, 60.0f };
    const juce::ModifierKeys left (juce::ModifierKeys::leftButtonModifier);
    fader.mouseDown (event (fader, from, from, left));
    fader.mouseDrag (event (fader, from.translated (0, 5), from, left));
    fader.mouseDrag (event (fader, from.translated (0, 10), from, left));
    fader.mouseUp (event (fader, from.translated (0, 10), from, left));
    REQUIRE (changes.size() == 2);
    CHECK_FALSE (changes[0].second);
    CHECK (changes[1].second);
    const double coarse = 1.0 - *changes[1].first;
    CHECK (coarse > 0.2);

    changes.clear();
    fader.show (1.0);
    const auto shift = left.withFlags (juce::ModifierKeys::shiftModifier);
    fader.mouseDown (event (fader, from, from, shift));
    fader.mouseDrag (event (fader, from.translated (0, 10), from, shift));
    REQUIRE (changes.size() == 1);
    CHECK (1.0 - *changes[0].first < 0.2 * coarse);
    const double fine = *changes[0].first;
    fader.mouseDrag (event (fader, from.translated (0, 11), from, left));   // Shift is released during the drag: the gain goes on from where it is
    REQUIRE (changes.size() == 2);
    CHECK (fine - *changes[1].first > 0.0);
    CHECK (fine - *changes[1].first < 0.2 * coarse);
    fader.mouseDrag (event (fader, from.translated (20, 11), from, left));   // sideways changes nothing
    CHECK (changes.size() == 2);

    changes.clear();
    fader.mouseDown (event (fader, from, from, left.withFlags (juce::ModifierKeys::altModifier)));
    REQUIRE (changes.size() == 1);
    CHECK_FALSE (changes[0].first);
}

TEST_CASE ("a turn of the wheel that scrolls the strips moves no fader that arrives under the pointer", "[layers]")
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    juce::Component row;
    row.setSize (2000, 116);
    Fader fader;
    int changes = 0;
    fader.onChange = [&] (std::optional<double>, bool) { ++changes; };
    fader.show (1.0);
    fader.setBounds (300, 0, 36, 116);
    row.addAndMakeVisible (fader);
    StripView view;
    view.setBounds (0, 0, 200, 130);
    view.setViewedComponent (&row, false);
    const auto turn = [&] {
        const juce::Point<float> at { 18.0f, 60.0f };
        fader.mouseWheelMove (event (fader, at, at, {}), { .deltaX = 0.0f, .deltaY = -0.2f, .isReversed = false, .isSmooth = false, .isInertial = false });
    };
    turn();
    CHECK (changes == 1);
    int place = 0;
    CHECK (tactus::test::eventually ([&] {   // on a busy computer, more than half a second may pass before the turn
        const int before = changes;
        view.setViewPosition (place = 200 - place, 0);
        turn();
        return changes == before;
    }));
    tactus::test::letPass (std::chrono::milliseconds (600));
    const int before = changes;
    turn();
    CHECK (changes == before + 1);
}

TEST_CASE ("a strip sets mute, solo, priority and name, and shows undone edits", "[layers]")
{
    Rig rig ("bronze_bell.json");
    auto& strip = rig.panel->layer (1);
    strip.setValue ("mute", Json (1), false);
    strip.setValue ("solo", Json (1), false);
    strip.setValue ("priority", Json (3), false);
    strip.rename ("hum");
    CHECK (layerValue (rig.mixer(), catalogue(), "mute", 1) == 1);
    CHECK (layerValue (rig.mixer(), catalogue(), "solo", 1) == 1);
    CHECK (layerValue (rig.mixer(), catalogue(), "priority", 1) == 3);
    CHECK (rig.mixer().settings["names"] == "blow, hum, warble");
    for (int i = 0; i < 4; ++i)
        rig.document->undo();
    CHECK_FALSE (rig.mixer().params.contains ("mute"));
    CHECK_FALSE (rig.document->isChanged());
}

TEST_CASE ("a layer is added together with a node, and removed again, each in one step", "[layers]")
{
    Rig rig ("bronze_bell.json");
    rig.panel->add ("vibration.modal");
    REQUIRE (rig.panel->layers() == 4);
    CHECK (rig.panel->layer (3).sourceText() == "modal.value");
    CHECK (rig.document->history().names().size() == 1);
    rig.panel->layer (0).remove();
    rig.settle();
    REQUIRE (rig.panel->layers() == 3);
    CHECK (rig.panel->layer (2).sourceText() == "modal.value");
    CHECK (rig.document->history().names().size() == 2);
    rig.document->undo();
    rig.document->undo();
    CHECK (rig.panel->layers() == 3);
    CHECK_FALSE (rig.document->isChanged());
}

TEST_CASE ("a graph without a mixer gets one at the click of a button", "[layers]")
{
    Rig rig ("steel_bar.json");
    CHECK (rig.panel->layers() == 0);
    CHECK (rig.picture().isValid());
    rig.panel->addMixerNow();
    rig.settle();
    CHECK (rig.panel->layers() >= 1);
    CHECK (rig.document->history().names() == std::vector<std::string> { "add a layer mixer" });
    rig.document->undo();
    CHECK (rig.panel->layers() == 0);
}

TEST_CASE ("during a run, the strips show the level after gain, and the spectrum", "[layers]")
{
    Rig rig ("bronze_bell.json");
    rig.live_run->start (LiveRun::Hand {});
    REQUIRE (rig.live_run->isRunning());
    double strongest = 0.0, sounded = 0.0;
    tactus::test::eventually (std::chrono::milliseconds (10), [&] {
        rig.live_run->poll();
        rig.panel->refresh();
        strongest = std::max (strongest, rig.panel->layer (1).meter().peak());
        for (const double p : rig.panel->layer (1).bands().power)
            sounded += p;
        return strongest > 0.05 && sounded > 0.0;
    });
    CHECK (strongest > 0.05);   // N
    CHECK (strongest < 10.0);
    CHECK (sounded > 0.0);
    CHECK (rig.picture().isValid());

    rig.panel->setVisible (false);   // a hidden panel needs only what the layers and the mix reach
    const auto ports = rig.live_run->traces().ports();
    const auto has = [&] (const char* end) { return std::ranges::count_if (ports, [&] (const std::string& p) { return p.find (end) != p.npos; }); };
    CHECK (has (".level[") == static_cast<std::ptrdiff_t> (rig.panel->layers()));
    CHECK (has (".out") == 1);
    CHECK (has ("motor.") > 0);
    CHECK (has (".in[") == 0);
}

TEST_CASE ("with several mixers, the shown one is kept through a rename, and another is shown when it is deleted", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("a", "layer.mix").node ("b", "layer.mix", Json::object(), { { "inputs", 5 } });
    Rig rig (sketch.graph);
    REQUIRE (rig.panel->mixers().size() == 2);
    CHECK (rig.panel->layers() == 2);
    rig.panel->choose (1);
    rig.settle();
    CHECK (rig.panel->layers() == 5);
    rig.document->perform (graph::RenameNode { "", "b", "c" });
    CHECK (rig.panel->layers() == 5);
    rig.panel->layer (4).setGain (Json (0.5), false);
    CHECK (rig.document->graph().root.find ("c")->params["gain"].size() == 5);
    rig.document->perform (graph::RemoveNode { "", "c" });
    CHECK (rig.panel->layers() == 2);
    rig.document->perform (graph::RemoveNode { "", "a" });
    CHECK (rig.panel->layers() == 0);
    rig.document->undo();
    rig.document->undo();
    CHECK (rig.panel->mixers().size() == 2);
}

TEST_CASE ("the master strip shows the gain reduction of the ceiling", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("loud", "signal.constant", { { "value", "2 N" } }).node ("motor", "device.force");
    sketch.node ("desk", "layer.mix", { { "ceiling", "1 N" } }, { { "inputs", 1 } });
    sketch.wire ("loud.out -> desk.in[0]").wire ("desk.out -> motor.force.z");
    Rig rig (sketch.graph);
    rig.live_run->start (LiveRun::Hand {});
    REQUIRE (rig.live_run->isRunning());
    REQUIRE (tactus::test::eventually (std::chrono::milliseconds (10), [&] {
        rig.live_run->poll();
        rig.panel->refresh();
        return rig.panel->mix()->reduction() > 0.0;
    }));
    CHECK (rig.panel->mix()->reduction() == Approx (20.0 * std::log10 (2.0)));
    CHECK (rig.panel->layer (0).meter().rms() == Approx (2.0));
}

TEST_CASE ("the levels of the strips, the mix, the motor and the status line agree, and what is not mixed has a strip of its own", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("loud", "signal.constant", { { "value", "2 N" } }).node ("past", "signal.constant", { { "value", "1 N" } }).node ("motor", "device.force");
    sketch.node ("desk", "layer.mix", { { "gain", { 0.4 } } }, { { "inputs", 1 } });
    sketch.wire ("loud.out -> desk.in[0]").wire ("desk.out -> motor.force.z").wire ("past.out -> motor.force.z");
    sketch.graph.root.wires.back().gain = Json (0.5);
    Rig rig (sketch.graph);
    REQUIRE (rig.panel->unmixed().size() == 1);
    CHECK (rig.panel->unmixed()[0]->signal().from == "past.out");
    rig.live_run->start (LiveRun::Hand {});
    REQUIRE (rig.live_run->isRunning());
    const auto forceNow = [&] {
        const auto status = rig.live_run->status();
        return status ? status->force : 0.0;
    };
    const auto settle = [&] (double force) {
        return tactus::test::eventually (std::chrono::milliseconds (10), [&] {
            rig.live_run->poll();
            rig.panel->refresh();
            return std::abs (forceNow() - force) < 1e-9 && std::abs (rig.panel->mix()->motorMeter().rms() - force) < 1e-9;
        });
    };
    CHECK (settle (1.3));
    CHECK (rig.panel->layer (0).meter().rms() == Approx (0.8));
    CHECK (rig.panel->mix()->meter().rms() == Approx (0.8));
    CHECK (rig.panel->unmixed()[0]->meter().rms() == Approx (0.5));
    CHECK (rig.picture().isValid());

    rig.panel->mixIn (rig.panel->unmixed()[0]->signal());
    rig.settle();
    CHECK (rig.panel->unmixed().empty());
    CHECK (rig.panel->mixers().size() == 2);   // the first one has one axis, and its mix is a layer of the second
    rig.panel->choose (1);
    rig.settle();
    REQUIRE (rig.panel->layers() == 2);
    CHECK (settle (1.3));
    CHECK (rig.panel->mix()->meter().rms() == Approx (1.3));
    CHECK (rig.panel->layer (0).meter().rms() + rig.panel->layer (1).meter().rms() == Approx (1.3));
    rig.document->undo();
    CHECK (rig.panel->unmixed().size() == 1);
}

TEST_CASE ("with many layers and scopes, every strip has its level, and the spectra share what is left", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("loud", "signal.constant", { { "value", "2 N" } }).node ("up", "vector.join").node ("motor", "device.force").wire ("loud.out -> up.z");
    sketch.node ("desk", "layer.mix_vectors", Json::object(), { { "inputs", 12 } }).wire ("desk.out -> motor.force");
    for (int i = 0; i < 12; ++i)
        sketch.wire ("up.out -> desk.in[" + std::to_string (i) + "]");
    for (int i = 0; i < 5; ++i)
        sketch.node ("s" + std::to_string (i), "vector.join").wire ("loud.out -> s" + std::to_string (i) + ".x");
    Rig rig (sketch.graph);
    Traces::Client scopes (rig.live_run->traces());
    const auto level = [&] (std::size_t i) { return rig.panel->layer (i).meter().rms(); };
    const auto allShow = [&] {
        return tactus::test::eventually (std::chrono::milliseconds (10), [&] {
            rig.live_run->poll();
            rig.panel->refresh();
            for (std::size_t i = 0; i < rig.panel->layers(); ++i)
                if (std::abs (level (i) - 2.0) > 1e-9) return false;
            return std::abs (rig.panel->mix()->meter().rms() - 24.0) < 1e-9;
        });
    };
    rig.live_run->start (LiveRun::Hand {});
    REQUIRE (rig.live_run->isRunning());
    CHECK (allShow());
    CHECK (rig.live_run->traces().leftOut().empty());   // spectra are no loss
    const auto partsOf = [&] (const std::string& port) { return rig.live_run->traces().of (port).size(); };
    CHECK (partsOf ("desk.in[0]") == 3);
    CHECK (partsOf ("desk.in[11]") == 0);
    scopes.want ({ "s0.out", "s1.out", "s2.out", "s3.out", "s4.out", "up.out", "loud.out" });
    CHECK (allShow());
    CHECK (partsOf ("s0.out") == 3);
    CHECK (partsOf ("desk.in[0]") == 0);
    CHECK (rig.live_run->traces().leftOut().size() == 6);   // 12 levels, reduction, mix and motor take 19 of 32 numbers, and 19 more are asked for
}

TEST_CASE ("a clip dropped on the desk becomes a layer, and without a mixer, the same step adds one", "[layers][clips]")
{
    const juce::StringArray clip { juce::String (TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic") };
    for (const auto* preset : { "bronze_bell.json", "door_knock.json" })
    {
        INFO (preset);
        Rig rig (preset);
        const auto before = writeGraph (rig.document->graph());
        const auto layers = rig.panel->layers();
        REQUIRE (rig.panel->isInterestedInFileDrag (clip));
        rig.panel->filesDropped (clip, 10, 10);
        CHECK (rig.panel->layers() >= layers + 1);
        CHECK (std::ranges::count (rig.document->graph().root.nodes, "signal.clip", &graph::Node::type) == 1);
        rig.document->undo();
        CHECK (writeGraph (rig.document->graph()) == before);
        rig.panel->filesDropped ({ juce::String (TACTUS_SOURCE_DIR "/README.md") }, 10, 10);
        CHECK (writeGraph (rig.document->graph()) == before);
    }
}

TEST_CASE ("the scales of the meters have units, also before the first run", "[layers]")
{
    Rig rig ("bronze_bell.json");
    rig.panel->setBounds (0, 0, 1400, 320);
    const auto check = [] (juce::Component& strip) {
        const auto texts = tactus::host::test::readTexts (strip);
        for (const char* mark : { "10 N", "1 N", "0.1 N", "10 mN", "1 mN" })
        {
            INFO (mark);
            CHECK (std::ranges::any_of (texts, [&] (const auto& t) { return t.text == mark && ! t.is_cut; }));
        }
    };
    check (rig.panel->layer (0));
    check (*rig.panel->mix());
}

TEST_CASE ("in a low panel, the strips scroll and their faders stay long enough to set", "[layers]")
{
    Rig rig ("bronze_bell.json");
    for (const int height : { 60, 108, 158, 200, 232, 400 })
        for (const int width : { 420, 540, 900 })
        {
            INFO (width << " x " << height);
            rig.panel->setSize (width, height);
            for (std::size_t i = 0; i < rig.panel->layers(); ++i)
            {
                auto& strip = rig.panel->layer (i);
                auto* row = strip.getParentComponent();
                CHECK (row->getLocalBounds().contains (strip.getBounds()));
                int faders = 0;
                for (auto* part : strip.getChildren())
                    if (dynamic_cast<Fader*> (part) != nullptr && part->isVisible() && part->getHeight() >= 64) ++faders;
                CHECK (faders == 1);
            }
            // All of the row can be scrolled to, and no more.
            auto* view = rig.panel->layer (0).findParentComponentOfClass<juce::Viewport>();
            CHECK (view->getViewedComponent()->getWidth() < static_cast<int> (rig.panel->layers() + 1) * LayerStrip::width + view->getViewWidth());
            if (height >= 232) CHECK (view->getViewHeight() == view->getViewedComponent()->getHeight());
        }
}

TEST_CASE ("a new layer is in view, and the first strip in view is whole", "[layers]")
{
    for (const int width : { 480, 540, 604, 700, 860 })
    {
        Rig rig ("bronze_bell.json");
        rig.panel->setSize (width, 232);
        for (int i = 0; i < 4; ++i)
        {
            rig.panel->add ("");
            INFO (width << " wide, " << rig.panel->layers() << " layers");
            auto& last = rig.panel->layer (rig.panel->layers() - 1);
            auto* view = last.findParentComponentOfClass<juce::Viewport>();
            CHECK (view->getViewPositionX() % LayerStrip::width == 0);
            CHECK (view->getViewArea().contains (last.getBounds()));
        }
    }
}
