// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include <host/app/canvas/align.hpp>
#include <host/app/canvas/arrange.hpp>
#include <host/app/canvas/route.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <string>

using namespace tactus::host;
using tactus::host::test::CanvasRig;
using Box2 = juce::Rectangle<float>;
using juce::Point;

namespace
{
bool touches (const juce::Path& path, Box2 box)
{
    for (float at = 0.0f; at < path.getLength(); at += 2.0f)
        if (box.reduced (1.0f).contains (path.getPointAlongPath (at))) return true;
    return false;
}

float between (int low, int high) { return static_cast<float> (*rc::gen::inRange (low, high)); }
}   // namespace

TEST_CASE ("a wire goes around an obstacle, wherever it is", "[app][route]")
{
    tactus::test::property ("one obstacle", [] {
        const Point<float> from { 0.0f, 0.0f }, to { 600.0f, between (-200, 200) };
        const Box2 start { -100.0f, -50.0f, 100.0f, 100.0f }, end { to.x, to.y - 50.0f, 100.0f, 100.0f };
        const Box2 obstacle { between (200, 300), between (-200, 200), between (40, 120), between (30, 200) };
        const auto waypoints = routeAround (from, to, start, end, { obstacle });
        RC_ASSERT (! touches (curveThrough (from, waypoints, to), obstacle));
    });
}

TEST_CASE ("a wire with a free path is direct, and a wire that runs back goes below the nodes", "[app][route]")
{
    const Box2 start { -100.0f, 0.0f, 100.0f, 100.0f };
    CHECK (routeAround ({ 0, 50 }, { 400, 90 }, start, { 400, 40, 100, 100 }, { { 100, 400, 80, 80 } }).empty());

    const Box2 end { -400.0f, 0.0f, 100.0f, 160.0f }, between_them { -250.0f, 40.0f, 80.0f, 300.0f };
    const auto waypoints = routeAround ({ 0, 50 }, { -400, 50 }, start, end, { between_them });
    REQUIRE (waypoints.size() == 2);
    CHECK (waypoints[0].y > between_them.getBottom());
    const auto path = curveThrough ({ 0, 50 }, waypoints, { -400, 50 });
    for (const auto& box : { start, end, between_them })
        CHECK_FALSE (touches (path, box));
}

TEST_CASE ("a wire runs level past a box that is above or below one of its nodes", "[app][route]")
{
    const Point<float> from { 0.0f, 100.0f }, to { 400.0f, 0.0f };
    const Box2 start { -100.0f, 80.0f, 100.0f, 40.0f }, end { 400.0f, -20.0f, 100.0f, 40.0f };
    const Box2 below_end { 300.0f, 5.0f, 180.0f, 100.0f }, above_start { -80.0f, -40.0f, 180.0f, 130.0f };
    for (const auto& obstacle : { below_end, above_start })
    {
        const auto waypoints = routeAround (from, to, start, end, { obstacle });
        CHECK_FALSE (waypoints.empty());
        CHECK_FALSE (touches (curveThrough (from, waypoints, to), obstacle));
    }
}

TEST_CASE ("in the presets, few wires run behind nodes, and none overlap", "[app][route]")
{
    int behind = 0, wires = 0;
    for (const auto& name : { "dry_wood", "layered_cloth", "potato_cut", "squealing_rubber", "two_fingers", "soft_pad" })
    {
        CanvasRig rig { CanvasRig::preset (name) };
        for (const auto& w : rig.canvas->scene().wires())
        {
            ++wires;
            const auto path = w.path();
            for (int i = 0; i < static_cast<int> (rig.canvas->scene().nodes().size()); ++i)
            {
                const auto box = rig.canvas->scene().nodes()[static_cast<std::size_t> (i)].bounds();
                behind += i != w.start && i != w.end && touches (path, box) ? 1 : 0;
            }
            for (const auto& other : rig.canvas->scene().wires())
                if (other.id < w.id && w.waypoints.size() >= 2 && other.waypoints.size() >= 2) CHECK_FALSE (w.waypoints[0] == other.waypoints[0]);
        }
    }
    INFO (behind << " of " << wires);
    CHECK (behind * 20 <= wires);
}

TEST_CASE ("aligning keeps the size and order of the boxes", "[app][align]")
{
    tactus::test::property ("any boxes", [] {
        std::vector<Box2> boxes;
        for (int i = *rc::gen::inRange (2, 8); i > 0; --i)
            boxes.emplace_back (between (0, 500), between (0, 500), between (20, 200), between (20, 200));
        for (const auto how : { Alignment::left, Alignment::right, Alignment::top, Alignment::bottom, Alignment::columns, Alignment::rows })
        {
            const auto to = aligned (boxes, how);
            RC_ASSERT (to.size() == boxes.size());
            for (std::size_t i = 0; i < to.size(); ++i)
            {
                RC_ASSERT (to[i].getWidth() == boxes[i].getWidth());
                RC_ASSERT (to[i].getHeight() == boxes[i].getHeight());
                if (how == Alignment::left) RC_ASSERT (to[i].getX() == to[0].getX());
                if (how == Alignment::bottom) RC_ASSERT (std::abs (to[i].getBottom() - to[0].getBottom()) < 1e-3f);
                for (std::size_t k = 0; k < i; ++k)
                {
                    if (how == Alignment::columns) RC_ASSERT ((to[i].getBottom() <= to[k].getY() || to[k].getBottom() <= to[i].getY()));
                    if (how == Alignment::rows && boxes[i].getX() < boxes[k].getX()) RC_ASSERT (to[i].getX() < to[k].getX());
                }
            }
        }
    });
}

TEST_CASE ("arranged boxes have room around them and more between columns that many wires join, and a chain is straight", "[app][arrange]")
{
    tactus::test::property ("any boxes and wires", [] {
        const int count = *rc::gen::inRange (1, 30);
        std::vector<Point<float>> sizes;
        std::vector<std::pair<int, int>> wires;
        for (int i = 0; i < count; ++i)
            sizes.emplace_back (between (60, 240), between (48, 320));
        for (int i = *rc::gen::inRange (0, 2 * count); i > 0; --i)
            wires.emplace_back (*rc::gen::inRange (0, count), *rc::gen::inRange (0, count));
        const auto places = arrange (sizes, wires);
        RC_ASSERT (places.size() == sizes.size());
        const auto box = [&] (std::size_t i) { return Box2 (places[i].x, places[i].y, sizes[i].x, sizes[i].y); };
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            RC_ASSERT (places[i].x >= 0.0f);
            RC_ASSERT (places[i].y >= 0.0f);
            for (std::size_t k = 0; k < i; ++k)
            {
                RC_ASSERT_FALSE (box (i).expanded (12.0f).intersects (box (k).expanded (12.0f)));   // 24 between boxes
                if (places[i].x >= box (k).getRight()) RC_ASSERT (places[i].x - box (k).getRight() >= 80.0f);
            }
        }
    });

    std::vector<Point<float>> sizes { { 100, 80 }, { 120, 200 }, { 90, 60 }, { 100, 140 } };
    const auto chain = arrange (sizes, { { 0, 1 }, { 1, 2 }, { 2, 3 } });
    for (std::size_t i = 0; i < chain.size(); ++i)
        CHECK (chain[i].y + sizes[i].y / 2 == Approx (chain[0].y + 40.0f).margin (8.0));
    const auto alone = arrange ({ { 100, 80 }, { 100, 80 } }, { { 0, 1 } });
    std::vector<std::pair<int, int>> many (10, { 0, 1 });
    const auto joined = arrange ({ { 100, 80 }, { 100, 80 } }, many);
    CHECK (joined[1].x > alone[1].x + 40.0f);
}

TEST_CASE ("a wire that runs back to a node above or below its own runs behind neither of them", "[app][route]")
{
    const Box2 start { -100.0f, 0.0f, 100.0f, 100.0f };
    const Point<float> from { 0.0f, 50.0f };
    for (const float gap : { 24.0f, 40.0f, 120.0f })
        for (const float shift : { -80.0f, -20.0f, 0.0f, 60.0f })
            for (const bool is_above : { true, false })
            {
                INFO ("gap " << gap << ", shift " << shift << ", above " << is_above);
                const Box2 end { -100.0f + shift, is_above ? -gap - 100.0f : 100.0f + gap, 140.0f, 100.0f };
                const Point<float> to { end.getX(), end.getCentreY() };
                const auto path = curveThrough (from, routeAround (from, to, start, end, {}), to);
                CHECK_FALSE (touches (path, start));
                CHECK_FALSE (touches (path, end));
            }
}

TEST_CASE ("the points along a path find each box that the path leads through", "[app][route]")
{
    tactus::test::property ("points every 8 units, as JUCE finds them one by one", [] {
        const auto place = [] { return Point<float> (between (-2000, 2000), between (-500, 500)); };
        const auto from = place(), to = place();
        const auto path = curveThrough (from, { place(), place() }, to);
        const auto corner = place();
        const Box2 box { corner.x, corner.y, between (20, 600), between (20, 300) };
        bool is_inside = false, is_near = false;
        for (float at = 0.0f; at < path.getLength(); at += 8.0f)
        {
            const auto p = path.getPointAlongPath (at);
            is_inside = is_inside || box.reduced (0.5f).contains (p);
            is_near = is_near || box.expanded (0.5f).contains (p);
        }
        const bool is_found = PathPoints (path).areIn (box);
        RC_ASSERT (is_found || ! is_inside);
        RC_ASSERT (is_near || ! is_found);
    });
}

namespace
{
/// Gratings that run next to each other on one hand, each through a gate of its own: many wires have the same ends.
tactus::graph::Graph manyLayers (int layers)
{
    using tactus::Json;
    auto nodes = Json::object();
    nodes["hand"] = { { "type", "device.position" }, { "role", "stylus" } };
    nodes["motor"] = { { "type", "device.force" }, { "role", "stylus" } };
    nodes["touch"] = { { "type", "contact.window" } };
    auto wires = Json::array();
    for (int i = 0; i < layers; ++i)
    {
        const auto n = std::to_string (i);
        nodes["g" + n] = { { "type", "texture.grating" } };
        nodes["s" + n] = { { "type", "vector.scale" } };
        nodes["l" + n] = { { "type", "signal.lfo" } };
        for (const auto& wire : { "hand.position -> g" + n + ".position", "g" + n + ".force -> s" + n + ".in", "touch.gain -> s" + n + ".gain",
                                  "s" + n + ".out -> motor.force" })
            wires.push_back (wire);
    }
    const Json file { { "format", "tactus-graph" }, { "version", 2 }, { "rate_hz", 2000 }, { "nodes", nodes }, { "wires", wires } };
    auto read = tactus::readGraph (file.dump());
    REQUIRE_FALSE (hasErrors (read.messages));
    return std::move (read.graph);
}

/// The processor time of a change that draws every wire again, in s.
double costOfChange (CanvasRig& rig)
{
    const auto began = std::clock();
    REQUIRE (rig.document.perform (tactus::graph::RemoveNode { "", "l1" }));
    rig.document.undo();
    return static_cast<double> (std::clock() - began) / CLOCKS_PER_SEC;
}
}   // namespace

TEST_CASE ("routing four times as many wires takes about four times as long", "[app][route]")
{
    CanvasRig few { manyLayers (15) }, many { manyLayers (60) };
    double least_few = 1e9, least_many = 1e9;
    for (int i = 0; i < 3; ++i)
    {
        least_few = std::min (least_few, costOfChange (few));
        least_many = std::min (least_many, costOfChange (many));
    }
    std::printf ("a change with 60 wires: %.1f ms; with 240: %.1f ms\n", 1e3 * least_few, 1e3 * least_many);
    CHECK (least_many < 12.0 * least_few);
}

TEST_CASE ("while a node of a large patch is dragged, only its own wires are routed, and all of them once it is dropped", "[app][route]")
{
    const auto [layers, is_large] = GENERATE (std::pair (40, true), std::pair (6, false));
    CanvasRig rig { manyLayers (layers) };
    const auto routes = [&] {
        std::map<std::string, std::vector<Point<float>>> all;
        for (const auto& w : rig.canvas->scene().wires())
            all[w.text] = w.waypoints;
        return all;
    };
    const auto isAsMadeAnew = [&] {
        const auto anew = rig.canvas->sceneOf (rig.graph());
        return std::ranges::equal (rig.canvas->scene().wires(), anew->wires(), {}, &SceneWire::waypoints, &SceneWire::waypoints);
    };
    const auto from = rig.title ("s3"), to = rig.title ("g4");   // onto the wire of another layer
    const auto before = routes();
    auto hand = rig.hand();
    hand.press (from);
    bool is_ever_late = false;
    for (const float part : { 0.3f, 0.6f, 1.0f })
    {
        hand.dragTo (from + (to - from) * part);
        is_ever_late = is_ever_late || ! isAsMadeAnew();
        for (const auto& [wire, route] : routes())
            if (is_large && wire.find ("s3.") == std::string::npos) CHECK (route == before.at (wire));
    }
    CHECK (is_ever_late == is_large);
    hand.release (to);
    CHECK (rig.node ("s3").at.getDistanceFrom (rig.node ("g4").at) < 20.0f);
    CHECK (isAsMadeAnew());
    CHECK (routes() != before);

    hand.press (to);
    hand.dragTo (from);
    CHECK (rig.canvas->cancelDrag());
    CHECK (isAsMadeAnew());
}

TEST_CASE ("a wire goes around a node without wires, but not while that is dragged, so that it can be inserted", "[app][route]")
{
    const std::string type = GENERATE ("vector.scale", "signal.lfo");   // an LFO has no input: it cannot be inserted
    auto read = tactus::readGraph (R"({ "format": "tactus-graph", "version": 2, "rate_hz": 2000, "wires": ["wall.force -> motor.force"], "nodes": {
        "wall": { "type": "deform.plane", "ui": { "at": [0, 0] } }, "free": { "type": ")"
                                   + type + R"(", "ui": { "at": [400, 0] } },
        "motor": { "type": "device.force", "role": "stylus", "ui": { "at": [800, 0] } } } })");
    REQUIRE_FALSE (hasErrors (read.messages));
    CanvasRig rig { std::move (read.graph) };
    const auto wire = [&]() -> const SceneWire& { return rig.canvas->scene().wires().front(); };
    const auto isBehindFree = [&] { return touches (wire().path(), rig.node ("free").bounds()); };
    CHECK_FALSE (isBehindFree());

    auto hand = rig.hand();
    const auto home = rig.title ("free"), aside = home.translated (0.0f, 400.0f);
    hand.press (home);
    hand.dragTo (home.translated (0.0f, 16.0f));
    CHECK (isBehindFree());
    hand.dragTo (aside);
    hand.release (aside);
    CHECK (wire().waypoints.empty());

    hand.drag (aside, home);
    CHECK (rig.hasWire ("wall.force -> free.in") == (type == "vector.scale"));
    CHECK (rig.hasWire ("wall.force -> motor.force") == (type == "signal.lfo"));
    CHECK_FALSE (isBehindFree());
}
