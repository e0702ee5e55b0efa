// SPDX-License-Identifier: GPL-3.0-or-later
// Presets that are added to the open graph in the window: dragged, from the menu, by keys, from the list of commands, and as files.
#include "host/app/support/window_rig.hpp"

#include <host/app/browser/browser.hpp>
#include <host/app/compose/banks.hpp>
#include <host/app/layers/mixer.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::latestStep;
using tactus::host::test::WindowRig;

namespace
{
/// The middle of the row of a preset, which is searched for first.
juce::Point<float> rowOf (WindowRig& w, const juce::String& name)
{
    auto& browser = w.view->part<PresetBrowser>();
    browser.search (name);
    WindowRig::settle();
    juce::ListBox* list = nullptr;
    for (auto* child : browser.getChildren())
        if (auto* box = dynamic_cast<juce::ListBox*> (child)) list = box;
    REQUIRE (list != nullptr);
    const auto& rows = browser.rows();
    const auto row = std::ranges::find_if (rows, [&] (const auto& r) { return r.preset != nullptr && juce::String (r.preset->name) == name; });
    REQUIRE (row != rows.end());
    const auto area = list->getRowPosition (static_cast<int> (row - rows.begin()), true);
    return w.stage->getLocalPoint (list, area.getCentre().withX (40)).toFloat();
}

juce::Point<float> canvasPoint (WindowRig& w, float x, float y)
{
    auto& canvas = w.view->canvas();
    return w.stage->getLocalPoint (&canvas, canvas.getLocalBounds().toFloat().getRelativePoint (x, y));
}

const graph::Node* block (WindowRig& w) { return w.graph().root.find ("soft_pad"); }

std::string textOf (const graph::Graph& g) { return writeGraph (g); }
}   // namespace

TEST_CASE ("a preset that is dragged onto the canvas is added as a node and a layer, and a click still opens it", "[app][compose]")
{
    WindowRig w ("dry_wood.json");
    const auto before = textOf (w.graph());
    const auto* const opened = w.view->document().identity();
    w.stage->drag (rowOf (w, "Soft pad"), canvasPoint (w, 0.5f, 0.85f));
    WindowRig::settle();
    CHECK (w.view->document().identity() == opened);
    REQUIRE (block (w) != nullptr);
    CHECK (w.view->canvas().selection() == Selection { block (w)->id });
    CHECK (latestStep (w.view->document()) == "add Soft pad");
    w.stage->move ({ 2.0f, 2.0f });   // until then, the line says what is under the pointer
    INFO (w.view->statusText());
    CHECK (w.view->statusText().contains ("a layer of desk"));
    CHECK (compose::bypassedBanks (w.graph(), catalogue()).empty());
    CHECK (mixersOf (w.graph()).size() == 2);   // before the motor, and inside of the block
    const auto& nodes = w.view->canvas().scene().nodes();
    for (const auto& a : nodes)
        for (const auto& b : nodes)
            if (a.id < b.id) CHECK_FALSE (a.bounds().intersects (b.bounds()));
    w.key ("ctrl + z");
    CHECK (textOf (w.graph()) == before);
    w.key ("ctrl + y");
    CHECK (block (w) != nullptr);

    w.stage->click (rowOf (w, "Velvet"));
    WindowRig::settle();
    if (w.view->asked().isOpen()) w.view->asked().answer (1);   // the changes are not saved
    CHECK (w.graph().name == "Velvet");
}

TEST_CASE ("the menu of a preset adds it or a part of it, and Ctrl+Return adds the chosen one", "[app][compose]")
{
    WindowRig w ("soft_pad.json");
    w.choose (rowOf (w, "Dry wood"), 2);   // Open, Add to this graph
    REQUIRE (w.graph().root.find ("dry_wood") != nullptr);
    w.choose (rowOf (w, "Dry wood"), 5);   // ..., without its walls, only its friction, only its textures
    const auto* part = w.graph().find ("dry_wood_2");
    REQUIRE (part != nullptr);
    CHECK (part->find ("grain") != nullptr);
    CHECK (part->find ("drag") == nullptr);

    w.key ("ctrl + f");
    w.stage->type ("velvet");
    WindowRig::settle();
    w.key ("ctrl + return");
    CHECK (w.graph().root.find ("velvet") != nullptr);
    CHECK (w.view->canvas().hasKeyboardFocus (true));
    CHECK (compose::bypassedBanks (w.graph(), catalogue()).empty());

    w.key ("ctrl + k");
    w.stage->type ("add denim without its walls");
    w.key ("return");
    WindowRig::settle();
    REQUIRE (w.graph().find ("denim") != nullptr);
    CHECK (w.graph().root.find ("denim") != nullptr);
}

TEST_CASE ("a file that is dropped on the canvas is added, and opens where nothing is open", "[app][compose]")
{
    const juce::StringArray file { juce::String (TACTUS_SOURCE_DIR "/graphs/soft_pad.json") };
    WindowRig w ("dry_wood.json");
    w.view->canvas().filesDropped (file, 200, 200);
    CHECK (w.graph().name == "Dry wood");
    CHECK (block (w) != nullptr);

    w.key ("ctrl + n");
    WindowRig::settle();
    if (w.view->asked().isOpen()) w.view->asked().answer (1);
    REQUIRE (w.graph().root.nodes.empty());
    w.view->canvas().filesDropped (file, 200, 200);
    WindowRig::settle();
    CHECK (w.graph().name == "Soft pad");
    CHECK (block (w) == nullptr);
}

TEST_CASE ("with several roles, the window asks once which device plays the added preset", "[app][compose]")
{
    WindowRig w ("two_fingers.json");
    w.view->canvas().filesDropped ({ juce::String (TACTUS_SOURCE_DIR "/graphs/soft_pad.json") }, 200, 200);
    auto& question = w.view->asked();
    REQUIRE (question.isOpen());
    CHECK (question.title().contains ("Soft pad"));
    CHECK (question.size() == 4);   // thumb, index, its own device, cancel
    question.answer (1);
    WindowRig::settle();
    CHECK_FALSE (question.isOpen());
    REQUIRE (block (w) != nullptr);
    CHECK (block (w)->roles.value ("finger", std::string()) == "index");
    for (const auto& m : w.view->run().messages())
        CHECK (m.severity != Message::Severity::error);
}

TEST_CASE ("a preset becomes a layer from the list of nodes", "[app][canvas][clipboard]")
{
    WindowRig w ("dry_wood.json");
    w.view->canvas().grabKeyboardFocus();
    w.key ("spacebar");
    w.stage->type ("bronze b");
    w.key ("return");
    WindowRig::settle();
    INFO (w.view->statusText());
    CHECK (w.graph().root.find ("bronze_bell") != nullptr);
    CHECK (compose::bypassedBanks (w.graph(), catalogue()).empty());
    w.key ("spacebar");
    w.stage->type ("lfo");
    w.key ("return");
    CHECK (std::ranges::count (w.graph().root.nodes, "signal.lfo", &graph::Node::type) == 1);
}

TEST_CASE ("the first node is where the double click was", "[app][canvas]")
{
    WindowRig w;
    w.key ("ctrl + n");
    auto& canvas = w.view->canvas();
    for (const auto& part : { juce::Point<float> (0.3f, 0.4f), juce::Point<float> (0.85f, 0.2f), juce::Point<float> (0.97f, 0.97f) })
    {
        w.key ("ctrl + n");
        const auto at = canvas.getLocalBounds().toFloat().getRelativePoint (part.x, part.y);
        const auto on_canvas = canvas.view().toCanvas (at);
        w.stage->doubleClick (w.stage->getLocalPoint (&canvas, at));
        WindowRig::settle();
        REQUIRE (w.titled ("Palette") != nullptr);
        w.stage->type ("plane");
        WindowRig::settle();
        w.key ("return");
        WindowRig::settle();
        REQUIRE (canvas.scene().nodes().size() == 1);
        const auto b = canvas.scene().nodes().front().bounds();
        INFO (part.toString() << ": " << on_canvas.toString() << " " << b.toString());
        CHECK (b.expanded (1.0f).contains (on_canvas));
        const juce::Rectangle<float> pixels (canvas.view().toPixels (b.getTopLeft()), canvas.view().toPixels (b.getBottomRight()));
        CHECK (canvas.getLocalBounds().toFloat().contains (pixels));
        w.key ("ctrl + z");
    }
}

TEST_CASE ("an oscillator that keys add and wire gets a free place at the left of what it feeds, in one step", "[app][compose][keyboard]")
{
    for (const auto& words : { "grain amp", "roughness", "board stiff" })
    {
        INFO (words);
        WindowRig w ("dry_wood.json", 1600, 1000);
        auto& canvas = w.view->canvas();
        const auto choose = [&] (const char* key, const char* text) {
            w.key (key);
            w.stage->type (text);
            w.key ("return");
            WindowRig::settle();
        };
        canvas.grabKeyboardFocus();
        choose ("spacebar", "lfo");
        const auto position = w.view->document().history().position();
        const auto* lfo = w.graph().root.find ("lfo");
        REQUIRE (lfo != nullptr);
        const auto id = lfo->id;
        const auto begun_at = canvas.scene().find (id)->at;
        choose ("w", words);
        const auto& wires = canvas.scene().wires();
        const auto wire = std::ranges::find (wires, "lfo.out", &SceneWire::source);
        REQUIRE (wire != wires.end());
        CHECK (wire->add);
        CHECK (wire->from.x < wire->to.x);
        const auto place = canvas.scene().find (id)->bounds();
        CHECK (std::ranges::none_of (canvas.scene().nodes(), [&] (const SceneNode& n) { return n.id != id && n.bounds().intersects (place); }));
        CHECK (w.view->document().history().position() == position + 1);
        w.key ("ctrl + z");
        CHECK (canvas.scene().find (id)->at == begun_at);
    }
}
