// SPDX-License-Identifier: GPL-3.0-or-later
// What a person does to reach a goal, action by action: each click, drag, typed word and key is one.
#include "host/app/support/environment.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/browser/browser.hpp>

#include <tactus/file/graph_file.hpp>

#include <iostream>
#include <set>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::Environment;
using tactus::host::test::WindowRig;

namespace
{
struct Person
{
    WindowRig w;
    int actions = 0;

    explicit Person (bool safe) : w ({}, 1280, 720, safe) {}

    Canvas& canvas() { return w.view->canvas(); }
    juce::Point<float> of (juce::Component& c) { return w.middleOf (c); }

    juce::Point<float> onCanvas (juce::Point<float> at)
    {
        REQUIRE (canvas().getLocalBounds().toFloat().contains (canvas().view().toPixels (at)));
        return w.onStage (at);
    }

    /// A visible place near a node, in pixels from its middle, just far enough away not to be on any node.
    juce::Point<float> near (const std::string& node, juce::Point<float> way)
    {
        auto at = w.node (node).bounds().getCentre();
        for (int i = 0; i < 100 && canvas().scene().nodeAt (at) != nullptr; ++i)
            at += way / canvas().view().zoom;
        return onCanvas (at + way / canvas().view().zoom);
    }

    juce::Point<float> port (const std::string& node, Role role, const std::string& id)
    {
        INFO (node << '.' << id);
        const auto& shown = w.node (node);
        const auto* socket = shown.box.find (role, id);
        REQUIRE (socket != nullptr);
        return onCanvas (shown.placeOf (*socket));
    }

    void click (const juce::String& text)
    {
        w.click (text);
        ++actions;
    }

    void click (juce::Component* c, int button = juce::ModifierKeys::leftButtonModifier)
    {
        REQUIRE (c != nullptr);
        const auto at = of (*c);
        auto* hit = w.stage->getComponentAt (at.toInt());
        REQUIRE ((hit == c || c->isParentOf (hit)));   // nothing covers it
        w.stage->click (at, button);
        ++actions;
        WindowRig::settle();
    }

    /// A right click, Down and Return.
    void chooseFirst (juce::Component* c)
    {
        REQUIRE (c != nullptr);
        w.choose (of (*c), 1);
        actions += 3;
    }

    void drag (juce::Point<float> from, juce::Point<float> to)
    {
        w.stage->drag (from, to);
        ++actions;
        WindowRig::settle();
    }

    void key (const juce::String& described)
    {
        w.key (described);
        ++actions;
        WindowRig::settle();
    }

    void type (const juce::String& word)
    {
        w.stage->type (word);
        ++actions;
        WindowRig::settle();
    }

    /// Drops a wire on the canvas, and adds the node that the word finds.
    void extend (juce::Point<float> from, juce::Point<float> to, const juce::String& word)
    {
        drag (from, to);
        type (word);
        key ("return");
    }

    /// Lets the window work until this is so.
    template <typename F>
    void await (F&& isSo)
    {
        for (int i = 0; i < 1000 && ! isSo(); ++i)
            WindowRig::settle (10);
        REQUIRE (isSo());
    }

    juce::Component* titled (const juce::String& title) { return w.titled (title); }
};

/// The force on the tool, averaged over a stroke at this height, in m.
Vec3 forceAt (const graph::Graph& g, double z)
{
    const auto compiled = compile (g, catalogue());
    REQUIRE (compiled.plan != nullptr);
    auto& role = compiled.plan->roles().front();
    Vec3 sum = Vec3::Zero(), sway = Vec3::Zero();
    constexpr int ticks = 4000;
    for (int i = 0; i < ticks; ++i)
    {
        role.state->reading.position = Vec3 (2e-5 * i, 0.0, z);
        compiled.plan->tick();
        Vec3 now = Vec3::Zero();
        for (const auto& sink : role.sinks)
            now += sink.effort (sink.node).force;
        sum += now;
        sway += now.cwiseAbs2();
    }
    return (sway / ticks - (sum / ticks).cwiseAbs2()).cwiseMax (0.0).cwiseSqrt() + (sum / ticks).cwiseAbs();
}

/// The saved graph has a plane, friction, and a grating that the knob turns up and that is felt only in contact.
void checkRoughBoard (const std::filesystem::path& file)
{
    const auto saved = loadGraph (file);
    REQUIRE_FALSE (hasErrors (saved.messages));
    CHECK (saved.graph.name == "Rough board");
    auto g = saved.graph;
    REQUIRE (g.controls.size() == 1);
    CHECK (g.controls[0].to.front().path == "grating.amplitude");
    CHECK (forceAt (g, 1e-3).norm() == 0.0);   // in the air
    g.controls[0].value = 0.0;
    const auto smooth = forceAt (g, -1e-3);
    CHECK (smooth.z() > 0.1);    // the plane
    CHECK (smooth.x() > 0.05);   // friction
    g.controls[0].value = 1.0;
    CHECK ((forceAt (g, -1e-3) - smooth).norm() > 0.01);   // the grating, by the knob
}
}   // namespace

TEST_CASE ("a person builds plane, friction, a gated grating and a knob, and saves, in 18 actions", "[app][person]")
{
    Person p { true };
    const Environment own_is { "TACTUS_GRAPHS", p.w.home.path() };
    p.key ("ctrl + n");
    p.key ("spacebar");
    p.type ("plane");
    p.key ("return");
    p.await ([&] { return WindowRig::tabIn (*p.w.view, *p.w.stage, "Problems 2").has_value(); });   // nothing can be felt yet
    p.click ("Problems 2");
    p.click ("Add a hand");
    p.click ("Add a motor");
    p.extend (p.port ("hand", Role::output, "position"), p.near ("hand", { 0.0f, 12.0f }), "friction");   // wires itself
    p.click ("Layers");
    p.click ("+ Texture");
    REQUIRE (p.canvas().selection() == tactus::host::Selection { p.w.graph().root.find ("grating")->id });   // what was added is selected
    const auto* source = WindowRig::buttonIn (*p.w.view, "grating_felt.out");
    REQUIRE (source != nullptr);
    const auto dot = source->getParentComponent()->createComponentSnapshot (source->getBounds().withWidth (1).translated (-5, 0));
    const auto force = themeOf (*p.w.view).of (tactus::Quantity::force);
    CHECK (dot.getPixelAt (0, dot.getHeight() / 2).getHue() == Approx (force.getHue()).margin (0.02));   // before it has run
    const auto isAsked = [] { return juce::Component::getNumCurrentlyModalComponents() > 0; };
    p.chooseFirst (p.titled ("Amplitude"));
    p.await ([&] { return p.w.graph().controls.size() == 1 && ! isAsked(); });
    p.key ("ctrl + s");
    p.await (isAsked);
    p.type ("rough board");   // the dialog waits for a name
    p.key ("return");
    const auto file = p.w.home / "rough board.json";
    p.await ([&] { return std::filesystem::exists (file); });
    INFO (p.actions << " actions");
    CHECK (p.actions <= 18);
    std::cout << "plane, friction, gated grating, knob, saved: " << p.actions << " actions\n";

    checkRoughBoard (file);
}

TEST_CASE ("keys alone build plane, friction, a gated grating and a knob, and save, in 25 actions", "[app][person][keyboard]")
{
    Person p { true };
    const Environment own_is { "TACTUS_GRAPHS", p.w.home.path() };
    const auto choose = [&] (const char* key, const char* words) {
        p.key (key);
        p.type (words);
        p.key ("return");
    };
    p.key ("ctrl + n");
    choose ("spacebar", "plane");
    p.await ([&] { return WindowRig::tabIn (*p.w.view, *p.w.stage, "Problems 2").has_value(); });
    choose ("ctrl + k", "add hand");   // a button of a panel that is not in front
    choose ("ctrl + k", "add motor");
    choose ("w", "resistance new");
    p.type ("friction");
    p.key ("return");
    choose ("ctrl + k", "texture");
    REQUIRE (p.canvas().selection() == tactus::host::Selection { p.w.graph().root.find ("grating")->id });
    choose ("ctrl + k", "amplitude new");
    p.await ([&] { return p.w.graph().controls.size() == 1; });
    p.key ("return");   // the name
    p.key ("ctrl + s");
    p.await ([] { return juce::Component::getNumCurrentlyModalComponents() > 0; });
    p.type ("rough board");
    p.key ("return");
    const auto file = p.w.home / "rough board.json";
    p.await ([&] { return std::filesystem::exists (file); });
    std::cout << "the same by keys: " << p.actions << " actions\n";
    CHECK (p.actions <= 25);
    checkRoughBoard (file);
}

TEST_CASE ("a person feels something in two actions", "[app][person]")
{
    Person p { false };
    p.click ("Dry wood");
    CHECK (p.w.view->run().isRunning());
    CHECK (p.w.view->run().hand() == LiveRun::Hand::pointer());
    auto* surface = p.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto at = p.of (*surface);
    p.w.stage->move (at);
    p.w.stage->press();   // one drag, which has not ended yet
    ++p.actions;
    bool is_felt = false;
    for (int i = 0; i < 2000 && ! is_felt; ++i)
    {
        p.w.stage->move (at.translated (static_cast<float> (i % 40), 0.0f));
        WindowRig::settle (10);
        const auto tool = p.w.view->run().tool();
        is_felt = tool && tool->force.norm() > 0.1;
    }
    p.w.stage->release();
    CHECK (is_felt);
    CHECK (p.actions == 2);
    CHECK (p.w.view->document().file().empty());   // it is a copy of the preset
    p.w.view->document().undo();
    CHECK_FALSE (p.w.view->part<WelcomePage>().isVisible());   // an empty graph does not bring it back
    p.w.view->run().letGo();
}

TEST_CASE ("a person finds a preset and loads it in three actions", "[app][person]")
{
    Person p { true };
    p.click (p.titled ("Search presets"));
    p.type ("liver");
    p.key ("return");
    CHECK (p.w.graph().name == "Liver");
    CHECK (p.actions == 3);
}

TEST_CASE ("a person types a name and Return, and gets what has this name", "[app][person]")
{
    Person p { true };
    p.click (p.titled ("Search presets"));
    p.type ("liver");
    p.key ("ctrl + f");   // what is typed next replaces it
    p.type ("soft pad");
    p.key ("return");
    CHECK (p.w.graph().name == "Soft pad");
    p.key ("ctrl + n");
    for (const auto& [word, type] :
         { std::pair { "hand", "device.position" }, std::pair { "motor", "device.force" }, std::pair { "contact", "contact.window" },
           std::pair { "friction", "friction.elasto_plastic" } })
    {
        p.key ("spacebar");
        p.type (word);
        p.key ("return");
        CHECK (p.w.graph().root.nodes.back().type == type);
    }
}

TEST_CASE ("presets are in view in a low window, whatever the user has opened and saved, and nothing is listed twice", "[app][person]")
{
    const TemporaryFolder mine;
    for (int i = 0; i < 9; ++i)
        std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/soft_pad.json", mine / ("pad_" + std::to_string (i) + ".json"));
    const Environment own_is { "TACTUS_GRAPHS", mine.path() };
    Person p { true };
    p.w.view->open (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs" / "." / "soft_pad.json");   // a preset, as a file
    for (const auto* file : { "pad_3.json", "pad_7.json", "pad_3.json" })
        p.w.view->open (mine / file);
    const auto rows = [&] { return p.w.view->part<PresetBrowser>().rows(); };
    CHECK (rows()[1].preset->file == mine / "pad_3.json");   // the latest
    CHECK (tactus::host::test::showsText (p.w.view->part<PresetBrowser>(), "Aluminium bar"));
    int factory = 0;   // presets that can be read besides the own graphs
    for (const auto& t : tactus::host::test::readTexts (p.w.view->part<PresetBrowser>()))
        factory += static_cast<int> (std::ranges::count (p.w.view->part<PresetBrowser>().shipped(), t.text.toStdString(), &Preset::name));
    CHECK (factory >= 2);
    const auto before = rows().size();
    const auto* list = dynamic_cast<juce::ListBox*> (p.titled ("Presets")->getChildComponent (2));
    REQUIRE (list != nullptr);
    const auto heading = list->getRowPosition (0, true).getCentre();
    p.w.stage->click (p.w.stage->getLocalPoint (list, heading).toFloat());
    WindowRig::settle();
    CHECK (rows().size() > before);
    std::set<std::filesystem::path> files;
    for (const auto& r : rows())
        if (r.preset != nullptr) CHECK (files.insert (std::filesystem::canonical (r.preset->file)).second);
    CHECK (files.contains (std::filesystem::canonical (mine / "pad_8.json")));
}
