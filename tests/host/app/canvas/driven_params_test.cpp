// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of params on a node: their order, and what wires set.
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include "support/sketch.hpp"

#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/model/readable.hpp>
#include <tactus/graph/endpoint_text.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using host::test::DeskStage;
using host::test::Hand;
using host::test::OnStage;
using host::test::showsText;
using host::test::waitFor;

using tactus::test::Sketch;

namespace
{
using Rows = std::vector<std::string>;

Rows rowsOf (const CanvasRig& rig, const std::string& node)
{
    Rows rows;
    float y = 0.0f;
    for (const auto& s : rig.node (node).box.sockets)
        if (s.port->role == Role::param)
        {
            CHECK (s.at.y > y);
            y = s.at.y;
            rows.push_back (s.port->id);
        }
    return rows;
}

/// The same rows, with one more where the datasheet has it.
Rows with (const Face& face, Rows rows, const std::string& one)
{
    if (std::ranges::count (rows, one) == 0) rows.push_back (one);
    std::ranges::sort (rows, {}, [&] (const std::string& id) { return face.find (Role::param, id) - face.params.data(); });
    return rows;
}

/// Friction whose coefficient a constant sets, and that nothing else of the graph changes.
Sketch drivenFriction()
{
    return Sketch {}.node ("level", "signal.constant", { { "value", 0.4 } }).node ("drag", "friction.elasto_plastic").wire ("level.out -> drag.mu");
}

std::string messagesOf (const LiveRun& run)
{
    std::string all;
    for (const auto& m : run.messages())
        all += m.id + ' ' + m.text + '\n';
    return all;
}
}   // namespace

TEST_CASE ("the rows of params stay where they are as one is set, reset and wired", "[app][canvas][rows]")
{
    CanvasRig rig { Sketch {}.node ("one", "signal.constant").node ("drag", "friction.elasto_plastic").graph };
    const auto face = rig.node ("drag").face;   // the same for each scene
    const auto first = rowsOf (rig, "drag");
    REQUIRE (first.size() == Box::most_params);
    REQUIRE (face->params.size() > first.size() + 1);
    for (const auto& p : face->params)
    {
        if (p.isChoice() || p.width != 1) continue;
        INFO (p.id);
        rig.canvas->commands().setParam (rig.node ("drag"), p, Json (p.sheet->initial[0]));
        const auto after_set = rowsOf (rig, "drag");
        CHECK (std::ranges::count (after_set, p.id) == 1);
        CHECK (with (*face, after_set, p.id) == after_set);   // in the order of the datasheet
        if (std::ranges::count (first, p.id) > 0) CHECK (after_set == first);
        rig.document.undo();
        CHECK (rowsOf (rig, "drag") == first);

        const auto from = rig.canvas->scene().findPort ({ rig.node ("one").id, Role::output, "out" });
        rig.canvas->commands().join (from, rig.canvas->scene().findPort ({ rig.node ("drag").id, Role::param, p.id }));
        CHECK (rowsOf (rig, "drag") == with (*face, first, p.id));   // a wire takes no row away
        rig.document.undo();
        CHECK (rowsOf (rig, "drag") == first);
    }
}

TEST_CASE ("a drag of the value on a node goes to the right and up, a tenth as far with Shift", "[app][canvas][rows]")
{
    CanvasRig rig { Sketch {}.node ("drag", "friction.elasto_plastic", { { "mu", 0.5 } }).graph };
    const auto mu = [&] { return rig.graph().root.find ("drag")->params.value ("mu", Json (0.0)).get<double>(); };
    const auto dragBy = [&] (float x, float y, int keys = 0) {
        const auto at = rig.value ("drag", "mu");
        const auto steps = rig.document.history().position();
        rig.hand().drag (at, at + juce::Point<float> (x, y), Hand::left (keys));
        CHECK (rig.document.history().position() == steps + 1);
        const double to = mu();
        rig.document.undo();
        return to - 0.5;
    };
    const double right = dragBy (40.0f, 0.0f);
    CHECK (right > 0.1);
    CHECK (dragBy (-40.0f, 0.0f) == Approx (-right).epsilon (0.01));
    CHECK (dragBy (0.0f, -40.0f) == Approx (right).epsilon (0.01));
    CHECK (dragBy (20.0f, -20.0f) == Approx (right).epsilon (0.01));
    CHECK (dragBy (40.0f, 0.0f, juce::ModifierKeys::shiftModifier) == Approx (0.1 * right).epsilon (0.05));
}

TEST_CASE ("what a wire sets is named on the node, follows the run, and is not set by hand", "[app][canvas][rows]")
{
    CanvasRig rig { drivenFriction().graph };
    const auto* row = rig.node ("drag").box.find (Role::param, "mu");
    REQUIRE (row != nullptr);
    CHECK (row->driver == "level.out");
    CHECK (row->value.empty());
    CHECK (showsText (*rig.canvas, "level.out"));

    const auto before = rig.text();
    const auto at = rig.value ("drag", "mu");
    rig.hand().doubleClick (at);
    CHECK (rig.canvas->getNumChildComponents() == 0);   // no editor
    CHECK (rig.hint.contains ("level.out"));
    rig.hint.clear();
    rig.hand().click (at, Hand::left (juce::ModifierKeys::altModifier));
    CHECK (rig.hint.contains ("level.out"));
    CHECK (rig.text() == before);
    rig.hand().drag (at, at - juce::Point<float> (0.0f, 40.0f));   // as by the title: moves the node
    CHECK_FALSE (rig.graph().root.find ("drag")->params.contains ("mu"));

    LiveState live;
    live.runs = true;
    live.driven[{ rig.node ("drag").id, "mu" }] = "0.123";
    rig.canvas->showLive (live);
    CHECK (showsText (*rig.canvas, "0.123"));
    CHECK_FALSE (showsText (*rig.canvas, "level.out"));
    rig.canvas->showLive ({});
    CHECK (showsText (*rig.canvas, "level.out"));

    auto adds = rig.graph();   // a wire that adds leaves the value to the user
    adds.root.wires[0].add = true;
    rig.document.open (std::move (adds), {}, "open");
    CHECK (rig.node ("drag").box.find (Role::param, "mu")->driver.empty());
    CHECK_FALSE (rig.node ("drag").box.find (Role::param, "mu")->value.empty());
}

TEST_CASE ("while the graph runs, the node and the inspector show what a wire sets a param to", "[app][inspector][rows]")
{
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    g.controls.clear();
    g.root.nodes.push_back (Sketch::makeNode ("level", "signal.constant", { { "value", "0.5 mm" } }));
    g.root.wires.push_back (*graph::parseWire ("level.out -> drag.d_max"));
    DeskStage w (g, 1280, 1000);
    auto& canvas = w.canvas;
    canvas.select ({ w.graph().root.find ("drag")->id });
    OnStage::settle();
    auto* field = dynamic_cast<NumberField*> (w.titled (juce::String (readable ("d_max"))));
    REQUIRE (field != nullptr);
    CHECK (field->isDriven());
    CHECK (field->spokenValue() == "level.out");
    CHECK (showsText (w.inspector, "from level.out"));

    const auto before = w.document.version();
    const auto middle = w.middleOf (*field);
    w.stage->drag (middle, middle + juce::Point<float> (50.0f, 0.0f));
    w.stage->doubleClick (middle);
    CHECK_FALSE (field->isEditing());
    CHECK_FALSE (field->type ("0.3 mm"));
    CHECK (w.document.version() == before);

    w.playback.start ({});
    const auto shown = [] (int um) { return juce::String (um) + juce::String::fromUTF8 (" \xc2\xb5m"); };
    INFO (messagesOf (w.playback.run()));
    REQUIRE (waitFor ([&] { return field->spokenValue() == shown (500); }));
    REQUIRE (waitFor ([&] { return showsText (canvas, shown (500)); }));
    w.document.perform (graph::SetParam { {}, "level", "value", Json ("0.6 mm") });
    CHECK (waitFor ([&] { return field->spokenValue() == shown (600); }));
    CHECK (showsText (canvas, shown (600)));
    w.playback.run().stop();
    CHECK (waitFor ([&] { return field->spokenValue() == "level.out"; }));
    CHECK (showsText (canvas, "level.out"));

    w.document.perform (graph::RemoveWire { {}, w.graph().root.wires.back().id });
    OnStage::settle();
    CHECK_FALSE (field->isDriven());
    CHECK (field->type ("0.3 mm"));
    CHECK (w.graph().root.find ("drag")->params["d_max"] == "0.3 mm");
    w.playback.run().letGo();
}

TEST_CASE ("a param that is driven from outside of its subgraph is marked inside, on the node and in the inspector", "[app][canvas][rows]")
{
    Sketch s;
    auto& inside = s.subgraph ("rub");
    s.add (inside, "drag", "friction.elasto_plastic");
    inside.expose.params.emplace_back ("grip", *graph::parseEndpoint ("drag.mu"));
    s.node ("level", "signal.constant", { { "value", 0.4 } }).node ("part", "graph:rub").wire ("level.out -> part.grip");
    DeskStage w (s.graph, 1280, 1000);
    auto& canvas = w.canvas;
    const auto& part = canvas.scene().nodes()[1];
    REQUIRE (part.name == "part");
    w.stage->doubleClick (w.stage->getLocalPoint (&canvas, canvas.view().toPixels (part.at + juce::Point<float> (40.0f, 14.0f))));
    OnStage::settle();
    REQUIRE (canvas.seen().path == "part/");
    CHECK (showsText (canvas, "level.out"));
    canvas.select ({ canvas.scene().nodes().front().id });
    OnStage::settle();
    auto* field = dynamic_cast<NumberField*> (w.titled (juce::String::fromUTF8 ("Parameter \xce\xbc, friction coefficient")));
    if (field == nullptr) field = dynamic_cast<NumberField*> (w.titled ("mu"));
    REQUIRE (field != nullptr);
    CHECK (field->isDriven());
    CHECK_FALSE (field->type ("0.3"));
    w.playback.start ({});
    INFO (messagesOf (w.playback.run()));
    CHECK (waitFor ([&] { return field->spokenValue() == "0.4"; }));
    CHECK (waitFor ([&] { return showsText (canvas, "0.4"); }));
    w.playback.run().letGo();
}

TEST_CASE ("each of 60 params that wires set shows its value while the graph runs", "[app][canvas][rows]")
{
    Sketch s;
    constexpr int count = 60;
    for (int i = 0; i < count; ++i)
    {
        const auto n = std::to_string (i);
        s.node ("level" + n, "signal.constant", { { "value", 0.4 } }).node ("drag" + n, "friction.elasto_plastic");
        s.wire ("level" + n + ".out -> drag" + n + ".mu");
    }
    DeskStage w (s.graph, 1280, 1000);
    w.playback.start ({});
    INFO (messagesOf (w.playback.run()));
    CHECK (waitFor ([&] { return w.canvas.highlighted().live.driven.size() == count; }));
    w.playback.run().letGo();
}
