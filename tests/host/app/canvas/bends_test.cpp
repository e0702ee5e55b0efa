// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include <host/app/canvas/actions.hpp>
#include <host/app/model/patch.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using host::test::Hand;

namespace
{
constexpr auto wire = "board.force -> motor.force";

std::vector<juce::Point<double>> bendsIn (const CanvasRig& rig, const std::string& text = wire)
{
    for (const auto& w : rig.canvas->scene().wires())
        if (w.text == text)
            for (const auto& g : rig.graph().root.wires)
                if (g.id == w.id) return bendsOf (g);
    return {};
}

/// The pixel of a point of the canvas, and back.
juce::Point<float> pixel (const CanvasRig& rig, juce::Point<double> p) { return rig.canvas->view().toPixels (p.toFloat()); }

/// The straight line between two points of a wire has at least this distance from its path.
float distanceFrom (const CanvasRig& rig, juce::Point<double> p)
{
    for (const auto& w : rig.canvas->scene().wires())
        if (w.text == wire)
        {
            juce::Point<float> nearest;
            w.path().getNearestPoint (p.toFloat(), nearest);
            return nearest.getDistanceFrom (p.toFloat());
        }
    return 1e9f;
}

int alt() { return juce::ModifierKeys::altModifier; }
}   // namespace

TEST_CASE ("a drag with Alt bends a wire through a place, a drag moves the bend, and Delete removes it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.text();
    const auto from = rig.middleOf (wire), to = from + juce::Point<float> (30.0f, 90.0f);
    rig.hand().drag (from, to, Hand::left (alt()));
    auto bends = bendsIn (rig);
    REQUIRE (bends.size() == 1);
    CHECK (pixel (rig, bends[0]).getDistanceFrom (to) < 2.0f);
    CHECK (distanceFrom (rig, bends[0]) < 0.5f);
    CHECK (rig.graph().root.nodes.size() == CanvasRig::preset ("dry_wood").root.nodes.size());   // nothing was copied

    rig.hand().drag (pixel (rig, bends[0]), pixel (rig, bends[0]) + juce::Point<float> (0.0f, 40.0f));
    bends = bendsIn (rig);
    REQUIRE (bends.size() == 1);
    CHECK (std::fmod (bends[0].x, static_cast<double> (Box::grid)) == 0.0);   // on the grid
    CHECK (std::fmod (bends[0].y, static_cast<double> (Box::grid)) == 0.0);
    CHECK (distanceFrom (rig, bends[0]) < 0.5f);

    SECTION ("bends are numbered along the wire")
    {
        const auto start = rig.port ("board", Role::output, "force"), end = rig.port ("motor", Role::input, "force");
        const auto bendAt = [&] (float part) {
            const auto& wires = rig.canvas->scene().wires();
            const auto shown = std::ranges::find (wires, wire, &SceneWire::text);
            const auto path = shown->path();
            CHECK (rig.canvas->commands().addBend (shown->id, path.getPointAlongPath (path.getLength() * part)));
        };
        bendAt (0.2f);
        bendAt (0.85f);
        bends = bendsIn (rig);
        REQUIRE (bends.size() == 3);
        CHECK (pixel (rig, bends[0]).getDistanceFrom (start) < pixel (rig, bends[2]).getDistanceFrom (start));
        CHECK (pixel (rig, bends[2]).getDistanceFrom (end) < pixel (rig, bends[0]).getDistanceFrom (end));
    }
    SECTION ("Delete removes the selected bend and not the wire, and so does a double click")
    {
        rig.hand().click (pixel (rig, bends[0]));
        rig.hand().key ("cursor down");
        CHECK (bendsIn (rig)[0].y == bends[0].y + static_cast<double> (Box::grid));
        rig.hand().key ("delete");
        CHECK (bendsIn (rig).empty());
        CHECK (rig.hasWire (wire));
        rig.hand().key ("ctrl + z");
        rig.hand().key ("ctrl + z");
        REQUIRE (bendsIn (rig) == bends);
        rig.hand().doubleClick (pixel (rig, bends[0]));
        CHECK (bendsIn (rig).empty());
        CHECK_FALSE (rig.request);   // no palette
        rig.hand().key ("delete");   // the wire is still selected
        CHECK_FALSE (rig.hasWire (wire));
    }
    SECTION ("each bend and each move is one step, and undoing them all gives the same file")
    {
        rig.document.undo();
        rig.document.undo();
        CHECK (rig.text() == before);
        rig.document.redo();
        rig.document.redo();
        CHECK (bendsIn (rig) == bends);
    }
    SECTION ("J bends a selected wire")
    {
        rig.canvas->select ({ rig.canvas->scene().wires().front().id });
        const auto text = rig.canvas->scene().wires().front().text;
        rig.hand().key ("j");
        CHECK (bendsIn (rig, text).size() == 1);
    }
}

TEST_CASE ("a bend under a node can be grabbed while its wire is selected", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto id = std::ranges::find (rig.canvas->scene().wires(), wire, &SceneWire::text)->id;
    const auto place = rig.canvas->view().toCanvas (rig.title ("drag"));
    REQUIRE (rig.canvas->commands().addBend (id, place));
    const auto bend = bendsIn (rig), to = std::vector { bend[0] + juce::Point<double> (0.0, 96.0) };

    rig.canvas->select ({});
    const auto at = rig.node ("drag").at;
    rig.hand().drag (pixel (rig, bend[0]), pixel (rig, bend[0]) + juce::Point<float> (24.0f, 0.0f));   // the node is above it
    CHECK (rig.node ("drag").at != at);
    CHECK (bendsIn (rig) == bend);
    rig.document.undo();
    REQUIRE (rig.node ("drag").at == at);

    rig.canvas->select ({ id });
    rig.hand().move (pixel (rig, bend[0]));
    CHECK (rig.hint.startsWith ("Bend"));
    rig.hand().drag (pixel (rig, bend[0]), pixel (rig, to[0]));
    CHECK (rig.node ("drag").at == at);
    CHECK (bendsIn (rig)[0].getDistanceFrom (to[0]) < static_cast<double> (Box::grid));

    rig.document.undo();
    rig.canvas->select ({ id });
    rig.hand().doubleClick (pixel (rig, bend[0]));
    CHECK (bendsIn (rig).empty());
    CHECK (rig.canvas->breadcrumbs().empty());
}

TEST_CASE ("bends are kept in the file, move with both nodes, and change nothing that is felt", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().drag (rig.middleOf (wire), rig.middleOf (wire) + juce::Point<float> (10.0f, 70.0f), Hand::left (alt()));
    const auto bends = bendsIn (rig);
    REQUIRE (bends.size() == 1);

    const auto read = readGraph (rig.text());
    REQUIRE (read.messages.empty());
    CHECK (writeGraph (read.graph) == rig.text());
    const auto same = std::ranges::find_if (read.graph.root.wires, [] (const graph::Wire& w) { return ! bendsOf (w).empty(); });
    REQUIRE (same != read.graph.root.wires.end());
    CHECK (bendsOf (*same) == bends);
    CHECK (same->from.node == "board");

    rig.canvas->select ({ rig.node ("board").id, rig.node ("motor").id });
    rig.hand().key ("cursor right");
    CHECK (bendsIn (rig)[0] == bends[0].translated (static_cast<double> (Box::grid), 0.0));
    rig.hand().drag (rig.title ("board"), rig.title ("board") + juce::Point<float> (0.0f, 160.0f));
    CHECK (bendsIn (rig)[0].y > bends[0].y + 50.0);
    rig.document.undo();
    rig.document.undo();
    CHECK (bendsIn (rig) == bends);

    rig.canvas->select ({ rig.node ("board").id });   // one of the two ends
    rig.hand().key ("cursor right");
    CHECK (bendsIn (rig) == bends);

    rig.canvas->select ({ rig.node ("board").id, rig.node ("motor").id });
    rig.hand().key ("ctrl + d");
    CHECK (std::ranges::count_if (rig.graph().root.wires, [] (const graph::Wire& w) { return ! bendsOf (w).empty(); }) == 2);
    rig.hand().key ("l");   // arranging makes new places
    CHECK (bendsIn (rig).empty());

    auto broken = CanvasRig::preset ("dry_wood");
    for (auto& w : broken.root.wires)
        w.extra["ui"] = Json { { "bends", Json::array ({ Json::array ({ 1, 2 }), "no point" }) } };
    CanvasRig other { std::move (broken) };
    CHECK (other.canvas->scene().wires().size() == CanvasRig::preset ("dry_wood").root.wires.size());
    for (const auto& w : other.canvas->scene().wires())
        CHECK_FALSE (w.has_bends);
}

TEST_CASE ("a wire that is selected or under the pointer shines through the nodes in front of it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto& scene = rig.canvas->scene();
    const auto shown = std::ranges::find (scene.wires(), wire, &SceneWire::text);
    REQUIRE (shown != scene.wires().end());
    const auto id = shown->id;
    const auto box = rig.node ("drag").bounds().toDouble();
    const double y = box.getY() + 14.0;   // in its header
    REQUIRE (rig.document.perform (bendWire (rig.graph(), "", id, { { box.getX() - 24.0, y }, { box.getRight() + 24.0, y } })));
    rig.canvas->select ({});
    const auto picture = [&] { return rig.canvas->createComponentSnapshot (rig.canvas->getLocalBounds()); };
    const auto header = juce::Rectangle<float> (pixel (rig, box.getTopLeft()), pixel (rig, { box.getRight(), y + 12.0 })).reduced (4.0f).toNearestInt();
    const auto differ = [&] (const juce::Image& a, const juce::Image& b) {
        int count = 0;
        for (int row = header.getY(); row < header.getBottom(); ++row)
            for (int x = header.getX(); x < header.getRight(); ++x)
                count += a.getPixelAt (x, row) != b.getPixelAt (x, row) ? 1 : 0;
        return count;
    };
    const auto plain = picture();
    rig.canvas->highlighted().hovered = id;
    CHECK (differ (picture(), plain) > 20);
    rig.canvas->highlighted().hovered = 0;
    CHECK (differ (picture(), plain) == 0);
    rig.canvas->select ({ id });
    CHECK (differ (picture(), plain) > 20);
}
