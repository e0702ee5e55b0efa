// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include <host/app/model/clipboard.hpp>
#include <host/app/model/with_prefix.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using host::test::Hand;

namespace
{
bool selects (const CanvasRig& rig, const std::string& name) { return rig.canvas->selection().contains (rig.node (name).id); }
}   // namespace

TEST_CASE ("a drag moves only the selected node, on the grid, as one undo step", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    std::map<std::string, juce::Point<float>> places;
    for (const auto& n : rig.canvas->scene().nodes())
        places[n.name] = n.at;
    rig.hand().drag (rig.title ("grain"), rig.title ("grain") + juce::Point<float> (61.0f, 33.0f));
    const auto moved = rig.node ("grain").at - places["grain"];
    CHECK (std::fmod (moved.x, Box::grid) == 0.0f);
    CHECK (moved.getDistanceFromOrigin() > 40.0f);
    for (const auto& n : rig.canvas->scene().nodes())
        if (n.name != "grain") CHECK (n.at == places[n.name]);
    CHECK (rig.document.history().names() == std::vector<std::string> { "move" });
}

TEST_CASE ("alt-dragging copies a node with its incoming wires", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().drag (rig.title ("grain"), rig.title ("grain") + juce::Point<float> (0.0f, 200.0f), Hand::left (juce::ModifierKeys::altModifier));
    CHECK (rig.hasWire ("hand.position -> grain_2.position"));
    CHECK (rig.node ("grain_2").at.y > rig.node ("grain").at.y + 100.0f);
    CHECK (rig.graph().root.find ("grain_2")->params["spatial_frequency"] == rig.graph().root.find ("grain")->params["spatial_frequency"]);
    CHECK (rig.graph().root.find ("grain_2")->params["amplitude"] == "60 mN");   // what the control of the original sets
}

TEST_CASE ("copied text is a graph file and can be pasted", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().click (rig.title ("drag"));
    rig.hand().click (rig.title ("board"), Hand::left (juce::ModifierKeys::shiftModifier));
    rig.hand().key ("ctrl + c");
    const auto read = readGraph (textFromClipboard());
    CHECK_FALSE (hasErrors (read.messages));
    CHECK (read.graph.root.nodes.size() == 2);
    CHECK (read.graph.root.wires.size() == 1);

    rig.hand().key ("ctrl + v");
    CHECK (rig.hasWire ("board_2.resistance -> drag_2.normal_force"));
    CHECK (rig.canvas->selection().size() == 2);
    rig.hand().key ("ctrl + v");   // beside the first copy
    CHECK (rig.node ("drag_3").at != rig.node ("drag_2").at);
    CHECK (rig.node ("drag_3").at - rig.node ("board_3").at == rig.node ("drag_2").at - rig.node ("board_2").at);
    rig.hand().key ("ctrl + z");
    rig.hand().key ("ctrl + z");
    CHECK (rig.graph().root.find ("drag_2") == nullptr);

    copyToClipboard ("no graph");
    rig.hand().key ("ctrl + v");
    CHECK (rig.hint.startsWith ("Nothing to paste"));
}

TEST_CASE ("a param can be dragged, typed with a unit and reset on its node", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto ratio = [&] { return rig.graph().root.find ("drag")->params.value ("static_ratio", Json()); };
    const auto first = ratio();
    const auto at = rig.value ("drag", "static_ratio");
    rig.hand().drag (at, at - juce::Point<float> (0.0f, 20.0f));
    CHECK (rig.document.history().names().size() == 1);
    const auto coarse = ratio().get<double>() - first.get<double>();
    CHECK (coarse > 0.0);
    rig.hand().key ("ctrl + z");
    CHECK (ratio() == first);

    rig.hand().drag (at, at - juce::Point<float> (0.0f, 20.0f), Hand::left (juce::ModifierKeys::shiftModifier));
    CHECK (ratio().get<double>() - first.get<double>() == Approx (coarse / 10).epsilon (0.2));
    rig.hand().key ("ctrl + z");

    rig.hand().click (at, Hand::left (juce::ModifierKeys::altModifier));
    CHECK (ratio().is_null());

    // Dragging a param that a control drives moves the control, within its range.
    const auto roughness = [&] { return rig.graph().controls[0].value; };
    rig.hand().drag (rig.value ("drag", "mu"), rig.value ("drag", "mu") - juce::Point<float> (0.0f, 400.0f));
    CHECK (roughness() == 1.0);
    CHECK (rig.node ("drag").box.find (Role::param, "mu")->value == "0.6");

    rig.hand().doubleClick (rig.value ("drag", "d_max"));
    auto* editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
    REQUIRE (editor != nullptr);
    editor->setText ("0.2 mm");
    editor->onReturnKey();
    CHECK (rig.graph().root.find ("drag")->params["d_max"] == "0.2 mm");

    rig.hand().doubleClick (rig.value ("drag", "d_max"));
    editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
    REQUIRE (editor != nullptr);
    editor->setText ("3 N");
    editor->onReturnKey();
    CHECK (rig.hint.contains ("does not fit d_max"));
    CHECK (rig.graph().root.find ("drag")->params["d_max"] == "0.2 mm");
}

TEST_CASE ("a subgraph can be created, entered, left and ungrouped", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().click (rig.title ("grain"));
    rig.hand().click (rig.title ("grain_felt"), Hand::left (juce::ModifierKeys::shiftModifier));
    rig.hand().key ("g");
    REQUIRE (rig.graph().graphs.size() == 1);
    rig.hand().click (rig.title ("group"));
    rig.hand().key ("return");
    CHECK (rig.canvas->patch() == "group");
    CHECK (rig.canvas->scene().nodes().size() == 2);
    CHECK (rig.canvas->address ("grain.force") == "group/grain.force");

    // Exposed ports are shown inside and can be hidden and exposed again.
    REQUIRE (rig.canvas->scene().exposed().size() == 3);
    rig.hand().click (rig.title ("grain"));
    rig.choice = 0;
    rig.hand().key ("o");
    REQUIRE (rig.choices[0].type == "grain.position");
    CHECK (rig.canvas->scene().exposed().size() == 2);
    rig.hand().key ("o");
    CHECK (rig.canvas->scene().exposed().size() == 3);
    rig.hand().key ("ctrl + z");
    rig.hand().key ("ctrl + z");

    // Edits inside apply to the subgraph.
    rig.hand().click (rig.title ("grain"));
    rig.hand().key ("b");
    CHECK (rig.graph().graphs[0].second.find ("grain")->bypass);
    rig.hand().key ("u");
    CHECK (rig.canvas->patch().empty());
    CHECK (selects (rig, "group"));

    // Ungrouped nodes are selected, where the subgraph was, and side by side as they were in it.
    const auto old_place = rig.node ("group").bounds();
    rig.canvas->commands().nudgeSelection ({ 400.0f, 640.0f });
    const auto group = rig.node ("group").bounds();
    REQUIRE (group.getY() > old_place.getY());
    rig.hand().key ("shift + g");
    CHECK (rig.graph().graphs.empty());
    REQUIRE (rig.graph().root.find ("grain") != nullptr);
    CHECK (rig.canvas->selection() == Selection { rig.node ("grain").id, rig.node ("grain_felt").id });
    const auto both = rig.node ("grain").bounds().getUnion (rig.node ("grain_felt").bounds());
    CHECK (std::abs (both.getCentreX() - group.getCentreX()) < 32.0f);
    CHECK (std::abs (both.getCentreY() - group.getCentreY()) < both.getHeight());
    CHECK_FALSE (rig.node ("grain").bounds().intersects (rig.node ("grain_felt").bounds()));
    CHECK (rig.document.history().names().back() == "ungroup");

    // Undoing the creation of the subgraph from inside it leads back out.
    rig.hand().key ("ctrl + z");
    rig.hand().key ("ctrl + z");
    rig.hand().doubleClick (rig.title ("group"));
    CHECK (rig.canvas->patch() == "group");
    rig.hand().key ("ctrl + z");
    rig.hand().key ("ctrl + z");
    CHECK (rig.canvas->patch().empty());
}

TEST_CASE ("moving a region moves the nodes in it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().click (rig.title ("grain"));
    rig.hand().key ("n");
    REQUIRE (rig.canvas->scene().notes().size() == 1);
    auto* editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
    REQUIRE (editor != nullptr);
    editor->setText ("the grain");
    editor->onReturnKey();
    CHECK (rig.canvas->scene().notes()[0].text == "the grain");

    const auto note = rig.canvas->scene().notes()[0].area;
    const auto node = rig.node ("grain").at, other = rig.node ("board").at;
    const auto grip = rig.canvas->view().toPixels (note.getTopLeft() + juce::Point<float> (12.0f, 8.0f));
    rig.hand().drag (grip, grip + juce::Point<float> (0.0f, 80.0f));
    const auto moved = rig.canvas->scene().notes()[0].area.getPosition() - note.getPosition();
    CHECK (moved.y > 40.0f);
    CHECK (rig.node ("grain").at == node + moved);
    CHECK (rig.node ("board").at == other);

    const auto colour = rig.canvas->scene().notes()[0].colour;
    rig.hand().key ("k");
    CHECK (rig.canvas->scene().notes()[0].colour != colour);
    rig.hand().key ("ctrl + z");

    // The region is stored in the file.
    CHECK (rig.graph().extra["ui"]["notes"][0]["text"] == "the grain");
    rig.hand().key ("delete");
    CHECK (rig.canvas->scene().notes().empty());
    CHECK (rig.graph().root.find ("grain") != nullptr);
}

TEST_CASE ("keys change the delay of a wire", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().click (rig.middleOf ("touch.gain -> grain_felt.gain"));
    rig.hand().key ("]");
    rig.hand().key ("]");
    CHECK (rig.hasWire ("touch.gain -> [2] -> grain_felt.gain"));
    rig.hand().key ("[");
    rig.hand().key ("[");
    rig.hand().key ("[");
    CHECK (rig.hasWire ("touch.gain -> grain_felt.gain"));
    rig.hand().key ("e");
    CHECK (rig.graph().root.wires[rig.graph().root.wires.size() - 1].id != 0);
    CHECK (std::ranges::count (rig.graph().root.wires, std::optional (false), &graph::Wire::enabled) == 1);
}

TEST_CASE ("W finds a node that does not exist yet by its name, after the nodes that exist", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto ask = [&] (const char* node, const char* words, std::size_t choice) {
        rig.canvas->select ({ rig.node (node).id });
        rig.query = words;
        rig.choice = choice;
        rig.hand().key ("w");
    };
    constexpr std::size_t none = 1000000;
    const auto count = rig.graph().root.nodes.size();
    ask ("board", "drag", none);
    REQUIRE_FALSE (rig.choices.empty());
    CHECK (rig.choices.front().type.find ("-> drag.") != std::string::npos);   // the node of this name
    ask ("board", "resistance friction", none);
    for (const auto& c : rig.choices)
        CHECK (c.type.find ("resistance") != std::string::npos);
    ask ("board", "clamp", none);
    REQUIRE_FALSE (rig.choices.empty());
    CHECK (rig.choices.front().type.starts_with ("signal.clamp"));
    CHECK (rig.choices.front().name.find ("new ") != std::string::npos);
    CHECK (rig.graph().root.nodes.size() == count);

    ask ("board", "resistance clamp", 0);
    REQUIRE (rig.graph().root.nodes.size() == count + 1);
    const auto& added = rig.graph().root.nodes.back();
    CHECK (added.type == "signal.clamp");
    CHECK (rig.hasWire ("board.resistance -> " + added.name + ".in"));
    rig.document.undo();
    CHECK (rig.graph().root.nodes.size() == count);   // node and wire are one step

    ask ("board", "resistance new", 0);
    CHECK (rig.request.has_value());   // the list of all nodes that fit
    ask ("board", "qqqqxyz", none);
    CHECK (rig.choices.empty());
}

TEST_CASE ("Tab in a value of a node goes to the next one, and a refused value stays for another try", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto middle = [&] (const char* node, const char* param) {
        const auto& n = rig.node (node);
        const auto row = n.box.find (Role::param, param)->row.translated (n.at.x, n.at.y);
        return rig.canvas->view().toPixels (row.getCentre());
    };
    const auto editor = [&]() -> juce::TextEditor* {
        for (auto* c : rig.canvas->getChildren())
            if (auto* e = dynamic_cast<juce::TextEditor*> (c)) return e;
        return nullptr;
    };
    rig.hand().doubleClick (middle ("board", "stiffness"));
    REQUIRE (editor() != nullptr);
    const auto before = rig.text();
    editor()->setText ("loud");
    editor()->onReturnKey();
    REQUIRE (editor() != nullptr);
    CHECK (editor()->getText() == "loud");
    CHECK (rig.text() == before);

    const auto first = editor()->getY();
    editor()->setText ("1 kN/m", false);
    CHECK (rig.canvas->keyPressed (juce::KeyPress (juce::KeyPress::tabKey)));
    INFO (rig.hint);
    CHECK_FALSE (rig.request);   // for a new node
    REQUIRE (editor() != nullptr);
    CHECK (editor()->getY() != first);
    CHECK (rig.text() != before);
    CHECK (rig.canvas->keyPressed (juce::KeyPress (juce::KeyPress::tabKey, juce::ModifierKeys::shiftModifier, 0)));
    REQUIRE (editor() != nullptr);
    CHECK (editor()->getY() == first);
    editor()->onEscapeKey();
    CHECK (editor() == nullptr);
}

TEST_CASE ("a click on one of several selected nodes selects it alone, and a drag moves them all", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto id = [&] (const char* name) { return rig.node (name).id; };
    const auto header = [&] (const char* name) {
        const auto box = rig.node (name).bounds();
        return rig.canvas->view().toPixels (box.getCentre().withY (box.getY() + 8.0f));
    };
    const Selection both { id ("board"), id ("drag") };
    rig.canvas->select (both);
    const auto before = rig.node ("board").at;
    rig.hand().drag (header ("drag"), header ("drag").translated (0.0f, 40.0f));
    CHECK (rig.canvas->selection() == both);
    CHECK (rig.node ("board").at.y > before.y);
    rig.hand().click (header ("drag"), Hand::left (juce::ModifierKeys::shiftModifier));
    CHECK (rig.canvas->selection() == Selection { id ("board") });
    rig.hand().click (header ("drag"), Hand::left (juce::ModifierKeys::shiftModifier));
    CHECK (rig.canvas->selection() == both);
    rig.hand().click (header ("drag"));
    CHECK (rig.canvas->selection() == Selection { id ("drag") });
}

TEST_CASE ("nodes can be selected, wired and probed with only the keyboard", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().key ("ctrl + cursor right");
    REQUIRE (rig.canvas->selection().size() == 1);
    for (int i = 0; i < 20 && ! selects (rig, "motor"); ++i)
        rig.hand().key ("ctrl + cursor right");
    CHECK (selects (rig, "motor"));

    rig.canvas->select ({ rig.node ("grain").id });
    rig.choice = 0;
    rig.hand().key ("w");
    REQUIRE_FALSE (rig.choices.empty());
    CHECK (rig.hasWire (rig.choices[0].type));
    rig.hand().key ("p");
    CHECK (rig.probed == std::vector<std::string> { "grain.force" });

    const auto x = rig.node ("grain").at.x;
    rig.hand().key ("cursor right");
    CHECK (rig.node ("grain").at.x == x + Box::grid);
}

TEST_CASE ("zooming with the wheel keeps the point under the pointer in place", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const juce::Point<float> at { 333.0f, 444.0f };
    const auto before = rig.canvas->view().toCanvas (at);
    rig.hand().wheel (at, 0.8f);
    rig.hand().wheel (at, -0.3f);
    CHECK (rig.canvas->view().toCanvas (at).getDistanceFrom (before) < 1e-3f);
    CHECK (rig.canvas->view().zoom != 1.0f);
    rig.hand().key ("home");
    CHECK (rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (rig.canvas->scene().bounds().getTopLeft())));
}

TEST_CASE ("a canvas that gets larger keeps its centre, and stays fitted to the patch until it is moved", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto centre = [&] { return rig.canvas->view().toCanvas (rig.canvas->getLocalBounds().toFloat().getCentre()); };
    const auto shownOf = [&] { return rig.canvas->getLocalBounds().toFloat(); };
    rig.canvas->frameAll();
    rig.canvas->setSize (500, 300);
    for (const auto& n : rig.canvas->scene().nodes())
        CHECK (shownOf().contains (rig.canvas->view().toPixels (n.bounds().getCentre())));
    CHECK (rig.canvas->view().zoom < 1.0f);
    rig.canvas->setSize (1200, 800);
    const auto fitted = rig.canvas->view();
    rig.canvas->frameAll();
    CHECK (rig.canvas->view() == fitted);

    rig.canvas->view().zoomAt ({ 300.0f, 200.0f }, 2.0f);
    const auto before = centre();
    const float zoom = rig.canvas->view().zoom;
    rig.canvas->setSize (1000, 900);
    CHECK (centre().getDistanceFrom (before) < 0.01f);
    CHECK (rig.canvas->view().zoom == zoom);
}

TEST_CASE ("the canvas stays inside a subgraph when it and its node are renamed", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().click (rig.title ("grain"));
    rig.hand().key ("g");
    REQUIRE (rig.graph().graphs.size() == 1);
    const auto subgraph = rig.graph().graphs.front().first;
    const auto node = std::ranges::find (rig.graph().root.nodes, "graph:" + subgraph, &graph::Node::type)->name;
    rig.canvas->enter (rig.node (node));
    REQUIRE (rig.document.perform (graph::RenameNode { "", node, "wood" }));
    CHECK (rig.canvas->address ("a.b") == "wood/a.b");
    REQUIRE (rig.document.perform (graph::RenameSubgraph { subgraph, "fibres" }));
    CHECK (rig.canvas->patch() == "fibres");
    rig.document.undo();
    rig.document.undo();
    CHECK (rig.canvas->patch() == subgraph);
    CHECK (rig.canvas->address ("a.b") == node + "/a.b");
    rig.document.undo();   // the subgraph no longer exists
    CHECK (rig.canvas->breadcrumbs().empty());
}

TEST_CASE ("every preset can be drawn, and a box around it selects all nodes", "[app][canvas]")
{
    for (const auto& entry : std::filesystem::directory_iterator (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        const auto loaded = loadGraph (entry.path());
        if (loaded.graph.root.nodes.empty()) continue;
        INFO (entry.path().string());
        CanvasRig rig { loaded.graph };
        const auto all = rig.canvas->scene().bounds();
        const auto& view = rig.canvas->view();
        rig.hand().drag (view.toPixels (all.expanded (20.0f).getTopLeft()), view.toPixels (all.expanded (20.0f).getBottomRight()));
        CHECK (rig.canvas->selection().size() == loaded.graph.root.nodes.size());
        CHECK (rig.canvas->scene().wires().size() == loaded.graph.root.wires.size());
        for (const auto& a : rig.canvas->scene().nodes())
            for (const auto& b : rig.canvas->scene().nodes())
                if (a.id < b.id) CHECK_FALSE (a.bounds().intersects (b.bounds()));
        const auto picture = rig.canvas->createComponentSnapshot (rig.canvas->getLocalBounds());
        CHECK (picture.getWidth() == 1200);
    }
}

TEST_CASE ("while nothing runs, a port says what it is, also at its label, and while it runs, a card does", "[app][words]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto at = rig.port ("drag", Role::output, "force");
    CHECK (rig.canvas->tooltipAt (at) == "drag.force  [N]  force on the tool");
    CHECK (rig.canvas->tooltipAt (at - juce::Point<float> (24.0f * rig.canvas->view().zoom, 0.0f)).startsWith ("drag.force"));
    CHECK (rig.canvas->tooltipAt (rig.nowhere()).isEmpty());
    const auto damping = rig.canvas->tooltipAt (rig.port ("board", Role::param, "damping"));
    CHECK (damping.contains (juce::String::fromUTF8 ("[N\xc2\xb7s/m]")));   // as in the fields
    CHECK (withPrefix (0.3, "N*s/m") == "0.30 N\xc2\xb7s/m");
    LiveState running;
    running.runs = true;
    rig.canvas->showLive (running);
    CHECK (rig.canvas->tooltipAt (at).isEmpty());
}
