// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include <host/app/history/history_panel.hpp>

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("clicking a step of the history goes there, backwards and forwards")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        Document document (loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph);
        HistoryPanel panel (document);
        panel.setSize (232, 400);
        for (int i = 1; i <= 4; ++i)
            REQUIRE (document.perform (graph::SetParam { "", "drag", "mu", Json (0.1 * i) }));
        auto* list = dynamic_cast<juce::ListBox*> (panel.getChildComponent (0));
        REQUIRE (list != nullptr);
        CHECK (list->getModel()->getNumRows() == 5);
        panel.goToRow (1);
        CHECK (document.history().position() == 1);
        CHECK (document.graph().root.find ("drag")->params["mu"] == 0.1);
        panel.goToRow (4);
        CHECK (document.graph().root.find ("drag")->params["mu"] == 0.4);
        panel.goToRow (0);
        CHECK (document.history().position() == 0);
        panel.goToRow (99);
        CHECK (document.history().position() == 0);
        CHECK (list->getModel()->getNumRows() == 5);   // undone steps stay

        panel.goToRow (2);
        REQUIRE (document.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
        CHECK (list->getModel()->getNumRows() == 4);
        panel.createComponentSnapshot (panel.getLocalBounds());   // paints without a display
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}

TEST_CASE ("the steps of a graph keep their names when another graph is opened, and when all of it is undone", "[app][history]")
{
    Document document (loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph);
    REQUIRE (document.perform (graph::SetParam { "", "drag", "mu", Json (0.3) }));
    document.open (loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph, {}, "open Bronze bell");
    REQUIRE (document.perform (graph::SetParam { "", "desk", "gain", Json::array ({ 1, 1, 0.25 }) }));
    const auto names = [&] { return std::vector<std::string> { document.stepName (0), document.stepName (1), document.stepName (2) }; };
    const auto before = names();
    CHECK (before[0].find (" -> 0.3") != std::string::npos);
    CHECK (before[2].find (" -> 0.25") != std::string::npos);
    for (const std::size_t position : { 2U, 1U, 0U, 1U, 3U })
    {
        document.goTo (position);
        INFO (position);
        CHECK (names() == before);
    }
}

TEST_CASE ("the first change of a value also stores where the nodes are, and is named with both values", "[app][history]")
{
    host::test::CanvasRig rig { host::test::CanvasRig::preset ("templates/stroke") };
    const auto latest = [&] { return rig.document.stepName (rig.document.history().size() - 1); };
    const auto& node = rig.node ("wall");
    rig.canvas->commands().setParam (node, *node.box.find (Role::param, "damping")->port, Json ("0.4 N*s/m"), graph::Step::own);
    CHECK (latest() == "wall: Damping 0.3 -> 0.4 N\xc2\xb7s/m");
    rig.document.undo();
    CHECK (latest() == "wall: Damping 0.3 -> 0.4 N\xc2\xb7s/m");

    const auto at = rig.value ("drag", "mu");   // a drag joins many changes
    rig.hand().drag (at, at.translated (30.0f, 0.0f));
    CHECK (latest().find (" -> ") != std::string::npos);
}

TEST_CASE ("the history names the layer whose gain is changed", "[app][history]")
{
    graph::Node desk;
    desk.name = "desk";
    desk.type = "layer.mix";
    desk.settings = { { "names", "wood, drum" }, { "inputs", 3 } };
    graph::Graph g;
    g.root.nodes.push_back (std::move (desk));
    Document document { std::move (g) };
    const auto change = [&] (Json gains) {
        REQUIRE (document.perform (graph::SetParam { {}, "desk", "gain", std::move (gains) }));
        return document.stepName (document.history().size() - 1);
    };
    CHECK (change (Json::array ({ 1.0, 0.5, 1.0 })) == "desk: Gain of drum 1 -> 0.5");
    CHECK (change (Json::array ({ 1.0, 0.5, 0.2 })) == "desk: Gain[2] 1 -> 0.2");   // it has no name
}

TEST_CASE ("the history says in plain words that nodes were grouped and that the graph was renamed", "[app][history]")
{
    host::test::CanvasRig rig { host::test::CanvasRig::preset ("templates/stroke") };
    const auto latest = [&] { return rig.document.stepName (rig.document.history().size() - 1); };
    rig.hand().click (rig.title ("grain"));
    rig.hand().click (rig.title ("touch"), host::test::Hand::left (juce::ModifierKeys::shiftModifier));
    rig.hand().key ("g");
    CHECK (latest().starts_with ("group "));
    CHECK (latest().find ("touch") != std::string::npos);
    REQUIRE (rig.document.perform (graph::SetHeader { .name = "Bark" }));
    CHECK (latest() == "rename the graph: Stroke -> Bark");
    REQUIRE (rig.document.perform (graph::SetHeader { .about = "Rough." }));
    CHECK (latest() == "describe the graph");
}
