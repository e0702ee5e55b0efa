// SPDX-License-Identifier: GPL-3.0-or-later
// Presets that are searched for, opened, and added to the open graph: dragged, from the menu, by keys, from the list of commands, and as files.
#include "host/app/support/desk_stage.hpp"

#include <host/app/browser/browser.hpp>
#include <host/app/layers/mixer.hpp>
#include <tactus/plan/compile.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::latestStep;

namespace
{
const std::filesystem::path soft_pad = TACTUS_SOURCE_DIR "/graphs/soft_pad.json";

/// A desk with the list of presets, which notes what it opens.
struct PresetStage : DeskStage
{
    PresetBrowser& browser = show<PresetBrowser> (presetsPanel);
    std::filesystem::path opened;

    explicit PresetStage (const std::string& preset) : DeskStage (preset)
    {
        desk.openGraph = [this] (const std::filesystem::path& file) { opened = file; };
    }

    /// The middle of the row of a preset, which is searched for first.
    juce::Point<float> rowOf (const juce::String& name)
    {
        browser.search (name);
        settle();
        juce::ListBox* list = nullptr;
        for (auto* child : browser.getChildren())
            if (auto* box = dynamic_cast<juce::ListBox*> (child)) list = box;
        REQUIRE (list != nullptr);
        const auto& rows = browser.rows();
        const auto row = std::ranges::find_if (rows, [&] (const auto& r) { return r.preset != nullptr && juce::String (r.preset->name) == name; });
        REQUIRE (row != rows.end());
        const auto area = list->getRowPosition (static_cast<int> (row - rows.begin()), true);
        return stage->getLocalPoint (list, area.getCentre().withX (40)).toFloat();
    }

    const graph::Node* block() const { return graph().root.find ("soft_pad"); }
    std::string text() const { return writeGraph (graph()); }
};
}   // namespace

TEST_CASE ("a preset that is dragged onto the canvas is added as a node and a layer, and a click still opens it", "[app][compose]")
{
    PresetStage w ("dry_wood.json");
    const auto before = w.text();
    const auto* const opened = w.document.identity();
    w.stage->drag (w.rowOf ("Soft pad"), w.stage->getLocalPoint (&w.canvas, w.canvas.getLocalBounds().toFloat().getRelativePoint (0.5f, 0.85f)));
    DeskStage::settle();
    CHECK (w.document.identity() == opened);
    REQUIRE (w.block() != nullptr);
    CHECK (w.canvas.selection() == Selection { w.block()->id });
    CHECK (latestStep (w.document) == "add Soft pad");
    w.stage->move ({ 2.0f, 2.0f });   // until then, the line says what is under the pointer
    INFO (w.status.text());
    CHECK (w.status.text().contains ("a layer of desk"));
    CHECK (compose::bypassedBanks (w.graph(), catalogue()).empty());
    CHECK (mixersOf (w.graph()).size() == 2);   // before the motor, and inside of the block
    const auto& nodes = w.canvas.scene().nodes();
    for (const auto& a : nodes)
        for (const auto& b : nodes)
            if (a.id < b.id) CHECK_FALSE (a.bounds().intersects (b.bounds()));
    w.key ("ctrl + z");
    CHECK (w.text() == before);
    w.key ("ctrl + y");
    REQUIRE (w.block() != nullptr);
    const auto controls = w.graph().controls.size();
    REQUIRE (layersOf (*w.graph().root.find ("desk"), catalogue()) == 4);
    w.canvas.select ({ w.block()->id });
    w.key ("delete");   // with its layer and its knobs
    CHECK (w.block() == nullptr);
    CHECK (layersOf (*w.graph().root.find ("desk"), catalogue()) == 3);
    CHECK (w.graph().controls.size() == 1);
    CHECK (controls > 1);
    w.key ("ctrl + z");
    CHECK (w.graph().controls.size() == controls);

    w.stage->click (w.rowOf ("Velvet"));
    DeskStage::settle();
    CHECK (w.opened.filename() == "velvet.json");
}

TEST_CASE ("the menu of a preset adds it or a part of it, and Ctrl+Return adds the chosen one", "[app][compose]")
{
    PresetStage w ("soft_pad.json");
    w.choose (w.rowOf ("Dry wood"), 2);   // Open, Add to this graph
    REQUIRE (w.graph().root.find ("dry_wood") != nullptr);
    w.choose (w.rowOf ("Dry wood"), 5);   // ..., without its walls, only its friction, only its textures
    const auto* part = w.graph().find ("dry_wood_2");
    REQUIRE (part != nullptr);
    CHECK (part->find ("grain") != nullptr);
    CHECK (part->find ("drag") == nullptr);

    w.panel->keys.front().act();   // Ctrl+F
    w.stage->type ("velvet");
    DeskStage::settle();
    w.key ("ctrl + return");
    CHECK (w.graph().root.find ("velvet") != nullptr);
    CHECK (w.canvas.hasKeyboardFocus (true));
    CHECK (compose::bypassedBanks (w.graph(), catalogue()).empty());

    const auto actions = w.panel->actions();   // which Ctrl+K finds
    const auto denim = std::ranges::find (actions, juce::String ("Add Denim: all but its walls"), &Panel::Action::name);
    REQUIRE (denim != actions.end());
    denim->act();
    REQUIRE (w.graph().find ("denim") != nullptr);
    CHECK (w.graph().root.find ("denim") != nullptr);
    const auto grain = std::ranges::find (actions, juce::String ("Add Dry wood: textures only"), &Panel::Action::name);
    REQUIRE (grain != actions.end());
    grain->act();
    REQUIRE (w.graph().find ("dry_wood_3") != nullptr);
    CHECK (w.graph().find ("dry_wood_3")->find ("grain") != nullptr);
    CHECK (w.graph().find ("dry_wood_3")->find ("drag") == nullptr);
    CHECK (std::ranges::find (actions, juce::String ("Add Dry wood: vibrations only"), &Panel::Action::name) == actions.end());   // it has none
}

TEST_CASE ("a file that is dropped on the canvas is added, and opens where nothing is open", "[app][compose]")
{
    const juce::StringArray file { juce::String (soft_pad.string()) };
    PresetStage w ("dry_wood.json");
    w.canvas.filesDropped (file, 200, 200);
    CHECK (w.graph().name == "Dry wood");
    CHECK (w.block() != nullptr);

    CHECK (w.opened.empty());

    w.document.open ({}, {}, "new graph");
    w.canvas.filesDropped (file, 200, 200);
    CHECK (w.opened == soft_pad);
    CHECK (w.block() == nullptr);
}

TEST_CASE ("with several roles, a question asks once which device plays the added preset", "[app][compose]")
{
    PresetStage w ("two_fingers.json");
    w.canvas.filesDropped ({ juce::String (soft_pad.string()) }, 200, 200);
    auto& question = w.question;
    REQUIRE (question.isOpen());
    CHECK (question.title().contains ("Soft pad"));
    CHECK (question.size() == 4);   // thumb, index, its own device, cancel
    question.answer (1);
    DeskStage::settle();
    CHECK_FALSE (question.isOpen());
    REQUIRE (w.block() != nullptr);
    CHECK (w.block()->roles.value ("finger", std::string()) == "index");
    CHECK (compile (w.graph(), catalogue()).plan != nullptr);
}

TEST_CASE ("in the search for presets, what Return opens is selected, and the arrow keys choose another", "[app][keyboard]")
{
    PresetStage w ("dry_wood.json");
    juce::ListBox* rows = nullptr;
    for (auto* child : w.browser.getChildren())
        if (auto* list = dynamic_cast<juce::ListBox*> (child)) rows = list;
    REQUIRE (rows != nullptr);
    const auto name = [&] (int row) { return rows->getModel()->getNameForRow (row).toStdString(); };
    w.panel->keys.front().act();
    CHECK (rows->getSelectedRow() < 0);
    w.stage->type ("wood");
    DeskStage::settle();
    REQUIRE (rows->getModel()->getNumRows() > 2);
    CHECK (rows->getSelectedRow() == 0);
    w.key ("cursor up");
    CHECK (rows->getSelectedRow() == 0);
    w.key ("cursor down");
    w.key ("cursor down");
    CHECK (rows->getSelectedRow() == 2);
    w.key ("cursor up");
    const auto second = name (1);
    w.key ("return");
    CHECK (w.browser.rows()[1].preset->file == w.opened);
    CHECK (w.browser.rows()[1].preset->name == second);

    const auto position = w.document.history().position();
    REQUIRE (w.document.perform (graph::SetHeader { .about = "soft" }));
    w.panel->keys.front().act();
    w.stage->type ("steel");
    w.key ("escape");   // gives the keyboard back
    CHECK (DeskStage::focused() == &w.canvas);
    w.key ("ctrl + z");
    CHECK (w.document.history().position() == position);
}

TEST_CASE ("a right or middle click on a preset opens and runs nothing", "[app][click]")
{
    PresetStage w ("dry_wood.json");
    auto* search = w.titled ("Search presets");
    REQUIRE (search != nullptr);
    const auto below = w.stage->getLocalPoint (search, juce::Point<int> (40, search->getHeight()));
    for (int y = below.y + 8; y < below.y + 300; y += 12)
        for (const int button : { juce::ModifierKeys::rightButtonModifier, juce::ModifierKeys::middleButtonModifier })
        {
            w.stage->click (juce::Point<int> (below.x, y).toFloat(), button);
            DeskStage::settle();
            CHECK (w.opened.empty());
        }
    bool opens = false;   // what a left click there does
    for (int y = below.y + 8; y < below.y + 300 && ! opens; y += 12)
    {
        w.stage->click (juce::Point<int> (below.x, y).toFloat());
        DeskStage::settle();
        opens = ! w.opened.empty();
    }
    CHECK (opens);
}
