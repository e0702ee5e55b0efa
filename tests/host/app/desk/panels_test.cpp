// SPDX-License-Identifier: GPL-3.0-or-later
// Panels with a desk, and without the window.
#include "host/app/support/desk_rig.hpp"
#include "host/app/support/window_rig.hpp"
#include "wires_panel.hpp"

#include <host/app/browser/browser.hpp>
#include <host/app/node_list/node_list.hpp>
#include <host/app/problems/problem_list.hpp>
#include <host/app/scopes/scope_panel.hpp>
#include <host/app/take/take_panel.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;
using tactus::host::test::WindowRig;

namespace
{
struct Maker
{
    const char* name;
    Panel (*make) (Desk&);
};

#define TACTUS_ROW(place, make) Maker { #make, make },
const std::vector<Maker> makers { TACTUS_PANELS (TACTUS_ROW) };
#undef TACTUS_ROW

graph::AddNode nodeOf (const std::string& name, const std::string& type)
{
    graph::Node n;
    n.name = name;
    n.type = type;
    return { "", n };
}

/// A key as it is written in one way, whatever the case and the spaces of its description.
std::string spelled (const juce::String& key) { return juce::KeyPress::createFromDescription (key).getTextDescription().toStdString(); }

/// The keys of all panels that act in the whole window.
std::vector<std::string> keysOfPanels()
{
    std::vector<std::string> keys;
    for (const auto& maker : makers)
    {
        DeskRig r;
        r.make<juce::Component> (maker.make);
        for (const auto& key : r.panel->keys)
            if (key.act) keys.push_back (spelled (key.key));
    }
    return keys;
}

/// The keys of the window and of the canvas, which a panel would take from them.
std::vector<std::string> keysOfWindow()
{
    std::vector<std::string> keys;
    for (const auto* key : { "escape", "shift + escape", "s", "v" })   // the stops, the clutch, and the last two snapshots
        keys.push_back (spelled (key));
    for (int n = 1; n <= snapshot_count; ++n)
        for (const auto* with : { "", "ctrl + ", "shift + " })
            keys.push_back (spelled (with + juce::String (n)));
    for (const auto& command : canvasCommands())
        for (const auto& key : juce::StringArray::fromTokens (command.keys, "|", {}))
            keys.push_back (spelled (key));
    const WindowRig w;
    w.view->allowQuit ([] {});
    for (const auto& key : w.view->keys())
        keys.push_back (spelled (key.key));
    return keys;
}

juce::Button* buttonIn (juce::Component& in, const juce::String& text)
{
    if (auto* b = dynamic_cast<juce::Button*> (&in); b != nullptr && b->getButtonText() == text) return b;
    for (auto* child : in.getChildren())
        if (auto* b = buttonIn (*child, text)) return b;
    return nullptr;
}
}   // namespace

TEST_CASE ("each panel works on a desk whose window answers nothing", "[app][desk]")
{
    const auto maker = GENERATE (from_range (makers));
    INFO (maker.name);
    DeskRig r ("dry_wood.json");
    auto& component = r.make<juce::Component> (maker.make);
    const auto& p = *r.panel;
    CHECK (p.name.isNotEmpty());
    CHECK (component.getTitle().isNotEmpty());   // for screen readers
    for (const auto& key : p.keys)
    {
        CHECK (juce::String (key.shown).isNotEmpty());
        CHECK (juce::String (key.help).isNotEmpty());
        if (key.act) CHECK (juce::KeyPress::createFromDescription (key.key).isValid());
    }
    for (const auto& call : { p.reload, p.restore, p.refresh, p.escape })
        if (call) call();
    r.document.perform (graph::SetParam { "", "drag", "mu", 0.3 });
    r.refresh();
    auto written = r.document.graph();
    if (p.keep) p.keep (written);
    if (p.title) CHECK (p.title().text.isNotEmpty());
    if (p.actions)
        for (const auto& action : p.actions())
            CHECK (action.name.isNotEmpty());
    component.setVisible (true);
    r.refresh();
    CHECK (component.createComponentSnapshot (component.getLocalBounds()).isValid());
    bool goes_on = false;
    if (p.close) p.close ([&] { goes_on = true; });
    CHECK (goes_on == static_cast<bool> (p.close));   // there is nothing that would be lost
    if (p.leave) CHECK_FALSE (p.leave());
}

TEST_CASE ("no two panels have the same key", "[app][desk]")
{
    auto keys = keysOfPanels();
    CHECK (keys.size() >= 2);
    std::ranges::sort (keys);
    CHECK (std::ranges::adjacent_find (keys) == keys.end());
}

TEST_CASE ("no panel takes a key of the window or of the canvas", "[app][desk]")
{
    const auto taken = keysOfWindow();
    for (const auto* known : { "ctrl + s", "ctrl + q", "?", "spacebar", "ctrl + shift + z" })
        CHECK (std::ranges::count (taken, spelled (known)) == 1);
    for (const auto& key : keysOfPanels())
    {
        INFO (key);
        CHECK (std::ranges::count (taken, key) == 0);
    }
}

TEST_CASE ("the list of problems says what the run says, counts it in its title, and mends it", "[app][desk][problems]")
{
    DeskRig r;
    auto& list = r.make<ProblemList> (problemsPanel);
    r.refresh();
    CHECK (r.panel->title().text == "Problems");
    REQUIRE (r.document.perform (nodeOf ("wall", "deform.plane")));
    r.refresh();
    REQUIRE_FALSE (list.messages().empty());
    CHECK (r.panel->title().text == "Problems " + juce::String (list.messages().size()));
    CHECK_FALSE (r.panel->title().alarms);   // what cannot be felt is no error
    const auto isNoHand = [] (const Message& m) { return m.id == "graph/no_hand"; };
    REQUIRE (std::ranges::any_of (list.messages(), isNoHand));
    auto* add = buttonIn (list, "Add a hand");
    REQUIRE (add != nullptr);
    add->onClick();
    r.refresh();
    CHECK (std::ranges::none_of (list.messages(), isNoHand));
}

TEST_CASE ("a node that only a scope shows is no problem, and is one when the scope is gone", "[app][desk][problems]")
{
    DeskRig r ("dry_wood.json");
    auto& list = r.make<ProblemList> (problemsPanel);
    REQUIRE (r.document.perform (nodeOf ("wave", "signal.lfo")));
    const auto isUnheard = [] (const Message& m) { return m.where.find ("wave") != std::string::npos; };
    r.refresh();
    CHECK (std::ranges::any_of (list.messages(), isUnheard));
    r.desk.probed = [] { return Desk::Ports { "wave.value" }; };
    r.refresh();
    CHECK (std::ranges::none_of (list.messages(), isUnheard));
}

TEST_CASE ("the list of nodes finds subgraphs that were added since it was shown", "[app][desk]")
{
    DeskRig r ("dry_wood.json");
    auto& list = r.make<NodeList> (nodesPanel);
    list.setVisible (true);
    const auto count = list.entries().size();
    REQUIRE (count > 50);
    r.canvas.commands().selectAll();
    r.canvas.commands().groupSelection();
    r.refresh();
    CHECK (std::ranges::count_if (list.entries(), [] (const PaletteEntry& e) { return e.type.starts_with ("graph:"); }) == 1);
}

TEST_CASE ("the search for commands opens a preset while nothing is open, and adds it to an open graph", "[app][desk][presets]")
{
    DeskRig empty, wood ("dry_wood.json");
    for (auto* r : { &empty, &wood })
    {
        r->make<PresetBrowser> (presetsPanel);
        r->panel->reload();
    }
    const auto offered = empty.panel->actions();
    CHECK (offered.size() >= 40);
    CHECK (std::ranges::all_of (offered, [] (const Panel::Action& a) { return a.name.startsWith ("Open "); }));
    CHECK (wood.panel->actions().size() >= 2 * 40);
    CHECK (wood.desk.presets().size() >= 40);
}

TEST_CASE ("a key of the window freezes the scopes, and the ports that they show are known to others", "[app][desk][scopes]")
{
    DeskRig r ("dry_wood.json");
    auto& scopes = r.make<ScopePanel> (scopesPanel);
    r.panel->restore();
    const auto before = r.desk.probed();
    r.desk.probe ({ "drag.deflection" });
    const auto now = r.desk.probed();
    CHECK (std::ranges::count (before, "drag.deflection") == 0);
    CHECK (std::ranges::count (now, "drag.deflection") == 1);
    REQUIRE (r.panel->keys.size() == 1);
    r.panel->keys.front().act();
    CHECK (scopes.isFrozen());
    r.panel->keys.front().act();
    CHECK_FALSE (scopes.isFrozen());
}

TEST_CASE ("the fit of a recording covers the window until Esc closes it", "[app][desk][fit]")
{
    DeskRig r;
    auto& component = r.make<juce::Component> (fitPanel);
    CHECK_FALSE (component.isVisible());
    r.home.write ("text.csv", "no numbers\n");
    r.desk.fitRecording (r.home / "text.csv");
    CHECK (component.isVisible());
    r.panel->escape();
    CHECK_FALSE (component.isVisible());
}

TEST_CASE ("the panel of the page follows the graph, and comes to the front by its key", "[app][desk]")
{
    DeskRig r ("dry_wood.json");
    auto& wires = r.make<juce::Component> (wiresPanel);
    const auto pixels = [&] {
        r.refresh();
        juce::MemoryOutputStream png;
        juce::PNGImageFormat().writeImageToStream (wires.createComponentSnapshot (wires.getLocalBounds()), png);
        return png.getMemoryBlock();
    };
    const auto before = pixels();
    CHECK (pixels() == before);
    REQUIRE (r.document.perform (nodeOf ("extra", "signal.lfo")));
    CHECK (pixels() != before);
    const juce::Component* shown = nullptr;
    r.desk.reveal = [&] (const juce::Component& c) { shown = &c; };
    r.panel->keys.front().act();
    CHECK (shown == &wires);
}
