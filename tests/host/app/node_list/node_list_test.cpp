// SPDX-License-Identifier: GPL-3.0-or-later
// The list of nodes.
#include "host/app/support/desk_stage.hpp"

#include <host/app/node_list/node_list.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::waitFor;

namespace
{
/// A desk with the list of nodes.
struct NodesStage : DeskStage
{
    NodeList& nodes = show<NodeList> (nodesPanel);

    NodesStage() : DeskStage ("dry_wood.json", 1600, 900) {}

    /// The place of a node of the list on the screen.
    juce::Point<float> rowOf (const std::string& type)
    {
        juce::ListBox* list = nullptr;
        for (auto* child : nodes.getChildren())
            if (auto* l = dynamic_cast<juce::ListBox*> (child)) list = l;
        const auto at = std::ranges::find (nodes.entries(), type, &PaletteEntry::type);
        REQUIRE (list != nullptr);
        REQUIRE (at != nodes.entries().end());
        const auto row = static_cast<int> (at - nodes.entries().begin());
        list->scrollToEnsureRowIsOnscreen (row);
        settle();
        return stage->getLocalPoint (list, list->getRowPosition (row, true).getCentre()).toFloat();
    }
};
}   // namespace

TEST_CASE ("a node is dragged from the list to the canvas", "[app][beginnings]")
{
    NodesStage w;
    auto& canvas = w.canvas;
    const auto onStage = [&] (juce::Point<float> pixel) { return w.stage->getLocalPoint (&canvas, pixel); };
    const auto count = w.graph().root.nodes.size();
    const juce::Point<float> free { 16.0f, 16.0f };
    const auto place = canvas.view().toCanvas (free);
    w.stage->drag (w.rowOf ("signal.lfo"), onStage (free));
    DeskStage::settle();
    REQUIRE (w.graph().root.nodes.size() == count + 1);
    CHECK (w.graph().root.nodes.back().type == "signal.lfo");
    CHECK (canvas.scene().nodes().back().at.getDistanceFrom (place) < 40.0f);
    CHECK (canvas.hasKeyboardFocus (true));
    w.key ("ctrl + z");
    CHECK (w.graph().root.nodes.size() == count);
}

TEST_CASE ("a node is dragged from the list into a wire", "[app][beginnings]")
{
    NodesStage w;
    auto& canvas = w.canvas;
    const auto onStage = [&] (juce::Point<float> pixel) { return w.stage->getLocalPoint (&canvas, pixel); };
    const auto count = w.graph().root.nodes.size();
    auto* search = w.titled ("Search nodes");
    REQUIRE (search != nullptr);
    w.stage->click (w.middleOf (*search));
    w.stage->type ("reconstruction");
    REQUIRE (waitFor ([&] { return w.nodes.entries().front().type == "filter.reconstruction"; }));
    const auto wire = std::ranges::find (canvas.scene().wires(), "drag.force -> motor.force", &SceneWire::text);
    REQUIRE (wire != canvas.scene().wires().end());
    const auto path = wire->path();
    w.stage->drag (w.rowOf ("filter.reconstruction"), onStage (canvas.view().toPixels (path.getPointAlongPath (path.getLength() / 2))));
    DeskStage::settle();
    REQUIRE (w.graph().root.nodes.size() == count + 1);
    CHECK (std::ranges::count (canvas.scene().wires(), "drag.force -> motor.force", &SceneWire::text) == 0);
    CHECK (std::ranges::count (canvas.scene().wires(), "drag.force -> reconstruction.in", &SceneWire::text) == 1);
}

TEST_CASE ("the list of nodes finds as the palette does, Return adds, and Esc gives the keyboard back", "[app][beginnings]")
{
    NodesStage w;
    auto* search = w.titled ("Search nodes");
    REQUIRE (search != nullptr);
    w.stage->click (w.middleOf (*search));
    w.stage->type ("grating");
    REQUIRE (waitFor ([&] { return w.nodes.entries().front().type == "texture.grating"; }));   // JUCE tells of typed text later
    const auto count = w.graph().root.nodes.size();
    w.key ("return");
    CHECK (w.graph().root.nodes.size() == count + 1);
    w.stage->click (w.middleOf (*search));
    w.key ("escape");
    CHECK (w.canvas.hasKeyboardFocus (true));
}
