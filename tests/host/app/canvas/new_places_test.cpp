// SPDX-License-Identifier: GPL-3.0-or-later
// Where nodes go that the window adds by itself: to free places where their wires are short and cross no node.
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/desk_stage.hpp"

#include <host/app/canvas/actions.hpp>
#include <host/app/canvas/arrange.hpp>
#include <host/app/fit_panel/fit_panel.hpp>
#include <host/app/layers/layers_panel.hpp>
#include <host/app/problems/fixes.hpp>
#include <host/app/problems/problem_list.hpp>
#include <host/app/problems/unfelt.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/kit/random.hpp>

#include <fstream>
#include <sstream>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::CanvasRig;
using tactus::host::test::DeskStage;
using tactus::host::test::latestStep;
using tactus::host::test::waitFor;

namespace
{
/// The wires at these nodes that run through a node which is not at one of their ends.
std::vector<std::string> hiddenWires (const Scene& scene, const Selection& ids)
{
    std::vector<std::string> all;
    for (const auto& w : scene.wires())
    {
        const auto &from = scene.nodes()[static_cast<std::size_t> (w.start)], &to = scene.nodes()[static_cast<std::size_t> (w.end)];
        if (! ids.contains (from.id) && ! ids.contains (to.id)) continue;
        const auto path = w.path();
        for (const auto& n : scene.nodes())
            for (float at = 0.0f; n.id != from.id && n.id != to.id && at < path.getLength(); at += 4.0f)
                if (n.bounds().contains (path.getPointAlongPath (at)))
                {
                    all.push_back (w.text + " through " + n.name);
                    break;
                }
    }
    return all;
}

std::vector<std::string> overlaps (const Scene& scene, const Selection& ids)
{
    std::vector<std::string> all;
    for (const auto& a : scene.nodes())
        for (const auto& b : scene.nodes())
            if (a.id != b.id && ids.contains (a.id) && a.bounds().expanded (16.0f).intersects (b.bounds())) all.push_back (a.name + " on " + b.name);
    return all;
}

float lengthOf (const Scene& scene, const Selection& ids)
{
    float sum = 0.0f;
    for (const auto& w : scene.wires())
        if (ids.contains (scene.nodes()[static_cast<std::size_t> (w.start)].id) || ids.contains (scene.nodes()[static_cast<std::size_t> (w.end)].id))
            sum += w.path().getLength();
    return sum;
}

std::map<graph::Id, juce::Point<float>> placesIn (const Scene& scene)
{
    std::map<graph::Id, juce::Point<float>> all;
    for (const auto& n : scene.nodes())
        all[n.id] = n.at;
    return all;
}

bool isInView (const Canvas& canvas, juce::Rectangle<float> area)
{
    const auto& v = canvas.view();
    return canvas.getLocalBounds().toFloat().contains (juce::Rectangle<float> (v.toPixels (area.getTopLeft()), v.toPixels (area.getBottomRight())));
}

/// Without its hand, or its motors.
graph::Graph withoutDevices (const char* preset, const std::string& type)
{
    auto g = CanvasRig::preset (preset);
    std::vector<std::string> gone;
    for (const auto& n : g.root.nodes)
        if (n.type == type) gone.push_back (n.name);
    for (const auto& name : gone)
        REQUIRE (graph::apply (g, graph::RemoveNode { {}, name }));
    return g;
}
}   // namespace

TEST_CASE ("a new hand or motor gets a free place in every preset, and its wires go around the other nodes", "[app][canvas][places]")
{
    float added = 0.0f, arranged = 0.0f;
    int hidden = 0, presets = 0;
    std::string found;
    for (const auto& entry : std::filesystem::directory_iterator (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs"))
        for (const std::string type : { "device.position", "device.force" })
        {
            if (entry.path().extension() != ".json") continue;
            INFO (entry.path().stem().string() << ", " << type);
            CanvasRig rig { loadGraph (entry.path()).graph };
            std::vector<std::string> gone;
            for (const auto& n : rig.graph().root.nodes)
                if (n.type == type) gone.push_back (n.name);
            if (gone.empty()) continue;
            const auto& first = rig.canvas->scene().nodes().front();
            REQUIRE (rig.canvas->commands().perform (placeNodes (rig.graph(), {}, { { first.id, first.at } })));   // stores all places
            for (const auto& name : gone)
                REQUIRE (rig.document.perform (graph::RemoveNode { {}, name }));
            const auto before = placesIn (rig.canvas->scene());
            const auto text = rig.text();
            const auto position = rig.document.history().position();
            const auto missing = unfelt (rig.graph(), catalogue());
            const auto m = std::ranges::find (missing, type == "device.position" ? "graph/no_hand" : "graph/no_motor", &Message::id);
            if (m == missing.end()) continue;
            const auto made = rig.canvas->commands().performPlaced (fixOf (rig.graph(), *m)->command);
            REQUIRE_FALSE (made.empty());
            const auto& scene = rig.canvas->scene();
            for (const auto& [id, at] : before)
                CHECK (scene.find (id)->at == at);   // the nodes of the user stay
            CHECK (overlaps (scene, made) == std::vector<std::string> {});
            if (type == "device.force")
                for (const auto& w : scene.wires())
                    if (const auto& from = scene.nodes()[static_cast<std::size_t> (w.start)], &to = scene.nodes()[static_cast<std::size_t> (w.end)];
                        made.contains (to.id))
                    {
                        INFO (w.text << ", motor " << to.bounds().toString() << ", source " << from.bounds().toString());
                        CHECK (to.bounds().getX() > from.bounds().getRight());   // to the right of its sources
                    }
            const auto through = hiddenWires (scene, made);
            for (const auto& w : through)
                found += "\n" + entry.path().stem().string() + ": " + w;
            hidden += static_cast<int> (through.size());
            for (const auto& n : rig.graph().root.nodes)
                CHECK (positionOf (n).has_value());
            CHECK (rig.document.history().position() == position + 1);
            ++presets;
            added += lengthOf (scene, made);
            rig.hand().key ("l");
            arranged += lengthOf (rig.canvas->scene(), made);
            rig.document.undo();
            rig.document.undo();
            CHECK (rig.text() == text);
        }
    UNSCOPED_INFO (presets << " graphs; wires through nodes: " << hidden << "; length of the new wires: " << added << ", after L: " << arranged);
    CHECK (presets > 20);
    INFO (found);
    CHECK (hidden <= 1);   // a long wire of padded_bench, for which the router finds no way around from any place of the hand
    CHECK (added < 1.5f * arranged);
}

TEST_CASE ("Add a hand, Add a motor and Wire in the Problems panel leave the other nodes where they are", "[app][canvas][places][problems]")
{
    const auto [width, height] = GENERATE (std::pair { 1368, 920 }, std::pair { 1048, 640 });
    const std::string type = GENERATE ("device.position", "device.force");
    const bool has_moved_view = GENERATE (false, true);
    DeskStage w (withoutDevices ("dry_wood", type), width, height);
    auto& canvas = w.canvas;
    auto& list = w.show<ProblemList> (problemsPanel);
    if (has_moved_view) canvas.view().origin += juce::Point<float> (3000.0f, 0.0f);
    const auto before = placesIn (canvas.scene());
    const auto text = writeGraph (w.graph());
    REQUIRE (waitFor ([&] { return ! list.messages().empty(); }));
    w.click (type == "device.position" ? "Add a hand" : "Add a motor");
    REQUIRE (canvas.scene().nodes().size() > before.size());
    Selection made;
    for (const auto& n : canvas.scene().nodes())
    {
        if (before.contains (n.id)) CHECK (before.at (n.id) == n.at);
        if (! before.contains (n.id)) made.insert (n.id);
    }
    CHECK (overlaps (canvas.scene(), made) == std::vector<std::string> {});
    CHECK (hiddenWires (canvas.scene(), made) == std::vector<std::string> {});
    for (const auto id : made)
        CHECK (isInView (canvas, canvas.scene().find (id)->bounds()));
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + z");
    CHECK (writeGraph (w.graph()) == text);
}

TEST_CASE ("a fit that is added to the graph gets a free place and its wires, in view, as one undo", "[app][canvas][places][fit]")
{
    const auto [width, height] = GENERATE (std::pair { 1368, 920 }, std::pair { 1048, 640 });
    const bool has_moved_view = GENERATE (false, true);
    DeskStage w ("dry_wood.json", width, height);
    auto& fit = w.show<FitPanel> (fitPanel);
    auto& canvas = w.canvas;
    if (has_moved_view) canvas.view().origin += juce::Point<float> (3000.0f, 0.0f);
    Random random { 3 };
    std::ostringstream rows;
    rows << "position,force,load\n";
    double d = 0.0, last = 0.0;
    for (int i = 0; i < 1200; ++i)
    {
        const double phase = std::fmod (i / 400.0, 1.0), x = 1e-3 * (1.0 - std::abs (2.0 * phase - 1.0));
        d = std::clamp (d + x - last, -1e-4, 1e-4);
        last = x;
        rows << x << "," << -0.8 * d / 1e-4 + 0.02 * random.normal() << ",2\n";
    }
    std::ofstream (w.home / "strokes.csv") << rows.str();
    const auto before = placesIn (canvas.scene());
    const auto text = writeGraph (w.graph());
    const auto position = w.document.history().position();
    w.desk.fitRecording (w.home / "strokes.csv");
    REQUIRE (waitFor ([&] { return fit.fitted().has_value(); }));
    w.click ("Add to this graph");
    CHECK (latestStep (w.document).starts_with ("add fit"));
    CHECK (w.document.history().position() == position + 1);
    Selection made;
    for (const auto& n : canvas.scene().nodes())
    {
        if (before.contains (n.id)) CHECK (before.at (n.id) == n.at);
        if (! before.contains (n.id)) made.insert (n.id);
    }
    REQUIRE (made.size() == 1);
    CHECK (canvas.selection() == made);
    const auto& node = *canvas.scene().find (*made.begin());
    CHECK (node.type == "friction.elasto_plastic");
    std::set<std::string> wires;
    const auto isNew = [&] (int i) { return made.contains (canvas.scene().nodes()[static_cast<std::size_t> (i)].id); };
    for (const auto& wire : canvas.scene().wires())
        if (isNew (wire.start) || isNew (wire.end)) wires.insert (wire.text);
    CHECK (wires
           == std::set<std::string> { "hand.position -> " + node.name + ".position", "board.resistance -> " + node.name + ".normal_force",
                                      node.name + ".force -> motor.force" });
    CHECK (overlaps (canvas.scene(), made) == std::vector<std::string> {});
    CHECK (hiddenWires (canvas.scene(), made) == std::vector<std::string> {});
    CHECK (isInView (canvas, node.bounds()));
    CHECK (unfelt (w.graph(), catalogue()).empty());
    canvas.grabKeyboardFocus();
    w.key ("ctrl + z");
    CHECK (writeGraph (w.graph()) == text);
    w.key ("ctrl + y");
    CHECK (canvas.scene().nodes().size() == before.size() + 1);
    CHECK (isInView (canvas, canvas.scene().find (*made.begin())->bounds()));
}

TEST_CASE ("new boxes go between what feeds them and what they feed, clear of boxes and wires", "[app][canvas][places]")
{
    using Area = juce::Rectangle<float>;
    const juce::Point<float> out { 100.0f, 20.0f }, in { 0.0f, 20.0f };
    SECTION ("beside a wall of boxes")
    {
        std::vector<Area> boxes { { 0, 0, 100, 60 }, { 600, 0, 100, 60 }, { 0, 0, 100, 60 }, { 250, -200, 100, 500 } };
        placeAmong (boxes, { true, true, false, true }, { { 0, 2, out, in }, { 2, 1, out, in } });
        CHECK (boxes[0] == Area (0, 0, 100, 60));
        for (const auto i : { 0u, 1u, 3u })
            CHECK_FALSE (boxes[2].expanded (20.0f).intersects (boxes[i]));
        CHECK (boxes[2].getX() > 100.0f);
        CHECK (boxes[2].getRight() < 600.0f);
    }
    SECTION ("without wires, below the others")
    {
        std::vector<Area> boxes { { 40, 0, 100, 60 }, { 0, 0, 100, 60 }, { 0, 0, 100, 60 } };
        placeAmong (boxes, { true, false, false }, {});
        CHECK (boxes[1].getY() > 60.0f);
        CHECK_FALSE (boxes[1].intersects (boxes[2]));
    }
    SECTION ("random boxes and wires: none overlaps, and the placed ones stay")
    {
        Random random { 7 };
        for (int round = 0; round < 60; ++round)
        {
            const auto count = 3 + static_cast<std::size_t> (20.0 * random.uniform());
            std::vector<Area> boxes;
            std::vector<bool> placed;
            for (std::size_t i = 0; i < count; ++i)
            {
                const auto onGrid = [&] (double spread) { return static_cast<float> (8.0 * std::round (spread * random.normal())); };
                const float x = onGrid (60.0);
                boxes.emplace_back (x, onGrid (40.0), 120.0f, 80.0f);
                placed.push_back (i % 4 != 0);
            }
            std::vector<Lead> leads;
            for (std::size_t i = 1; i < count; ++i)
                leads.push_back ({ static_cast<int> (i * 7 % count), static_cast<int> (i), out, in });
            const auto before = boxes;
            placeAmong (boxes, placed, leads);
            for (std::size_t i = 0; i < count; ++i)
            {
                if (placed[i]) CHECK (boxes[i] == before[i]);
                for (std::size_t k = 0; ! placed[i] && k < count; ++k)
                    if (i != k) CHECK_FALSE (boxes[i].intersects (boxes[k]));
            }
        }
    }
}

TEST_CASE ("a mixer before the motor leaves the motor in view", "[app][canvas][layers]")
{
    DeskStage w ("dry_wood.json", 1688, 1000);
    w.show<LayersPanel> (layersPanel);
    auto& canvas = w.canvas;
    canvas.frameStart();
    REQUIRE (canvas.isFitted());
    w.click ("Add a mixer before the motor");
    for (const auto& n : canvas.scene().nodes())
    {
        INFO (n.name);
        const auto b = n.bounds();
        const juce::Rectangle<float> pixels (canvas.view().toPixels (b.getTopLeft()), canvas.view().toPixels (b.getBottomRight()));
        CHECK (canvas.getLocalBounds().toFloat().contains (pixels));
    }
    CHECK (canvas.isFitted());
}

TEST_CASE ("a node that grows pushes those aside that it would cover, which keep their distance, in the step that lets it grow", "[app][canvas]")
{
    auto read = readGraph (R"({ "format": "tactus-graph", "version": 2,
      "nodes": { "value": { "type": "signal.constant", "ui": { "at": [-400, 0] } }, "drag": { "type": "friction.elasto_plastic", "ui": { "at": [0, 0] } },
        "below": { "type": "signal.constant", "ui": { "at": [0, 800] } }, "last": { "type": "signal.constant", "ui": { "at": [0, 1000] } },
        "beside": { "type": "signal.constant", "ui": { "at": [800, 0] } } } })");
    REQUIRE_FALSE (hasErrors (read.messages));
    CanvasRig rig { std::move (read.graph) };
    const auto box = [&] (const std::string& name) { return rig.node (name).bounds(); };
    const auto put = [&] (const std::string& name, float x, float y) {
        REQUIRE (rig.document.perform (placeNodes (rig.graph(), "", { { rig.node (name).id, { x, y } } })));
    };
    put ("below", 16.0f, box ("drag").getBottom() + 16.0f);
    put ("last", 0.0f, box ("below").getBottom() + 8.0f);
    put ("beside", box ("drag").getRight() + 16.0f, 0.0f);
    const auto before = rig.text();
    const auto steps = rig.document.history().position();

    const auto& drag = rig.node ("drag");
    const auto hidden = std::ranges::find_if (drag.face->params, [&] (const FacePort& p) {
        return p.width == 1 && ! p.isChoice() && drag.box.find (Role::param, p.id) == nullptr;
    });
    REQUIRE (hidden != drag.face->params.end());
    const auto wire = "value.out -> drag." + hidden->id;
    const float height = box ("drag").getHeight();
    REQUIRE (rig.document.perform (graph::Batch { "connect", { graph::AddWire { "", *graph::parseWire (wire) } } }));
    REQUIRE (box ("drag").getHeight() >= height + 16.0f);
    CHECK (box ("below").getY() == box ("drag").getBottom() + 16.0f);
    CHECK (box ("last").getY() == box ("below").getBottom() + 8.0f);
    CHECK (box ("below").getX() == 16.0f);
    CHECK (rig.document.history().position() == steps + 1);
    CHECK (latestStep (rig.document) == wire);
    rig.document.undo();
    CHECK (rig.text() == before);

    REQUIRE (rig.document.perform (graph::RenameNode { "", "drag", "the_drag_of_a_pen_on_a_rough_board" }));
    CHECK (box ("beside").getX() == box ("the_drag_of_a_pen_on_a_rough_board").getRight() + 16.0f);
    CHECK (box ("beside").getY() == 0.0f);
    rig.document.undo();
    CHECK (rig.text() == before);

    put ("below", 0.0f, box ("drag").getBottom() - 8.0f);   // the user lets them meet
    REQUIRE (rig.document.perform (graph::AddWire { "", *graph::parseWire (wire) }));
    CHECK (box ("below").getY() == box ("drag").getY() + height - 8.0f);
}
