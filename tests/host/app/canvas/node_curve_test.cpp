// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "support/sketch.hpp"

#include <host/app/canvas/node_curve.hpp>
#include <host/base/files/clip_io.hpp>
#include <tactus/kit/signal/clip_score.hpp>
#include <tactus/node/node_fault.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using tactus::test::Sketch;

namespace
{
std::shared_ptr<const PlotData> curveOfOne (const graph::Graph& g)
{
    const auto& node = g.root.nodes.front();
    return curveOf (g, {}, node, faceOf (g, g.root, node, catalogue()));
}

std::shared_ptr<const PlotData> curveOfOne (const std::string& type, Json params = Json::object(), Json settings = Json::object())
{
    return curveOfOne (Sketch {}.node ("one", type, std::move (params), std::move (settings)).graph);
}

/// The curve at a place, straight between its points.
double at (const PlotData& plot, double x)
{
    std::size_t i = 1;
    while (i + 1 < plot.x.size() && plot.x[i] < x)
        ++i;
    return plot.y[i - 1] + (plot.y[i] - plot.y[i - 1]) * (x - plot.x[i - 1]) / (plot.x[i] - plot.x[i - 1]);
}
}   // namespace

TEST_CASE ("a clip shows its envelope over its time", "[app][curve]")
{
    const auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/heartbeat.json").graph;
    const auto node = std::ranges::find (g.root.nodes, "signal.clip", &graph::Node::type);
    REQUIRE (node != g.root.nodes.end());
    const auto curve = curveOf (g, {}, *node, faceOf (g, g.root, *node, catalogue()));
    REQUIRE (curve != nullptr);
    const auto clip = loadClip (std::filesystem::path (g.folder) / "assets/heartbeat.haptic");
    REQUIRE (clip);
    CHECK (curve->x.back() == Approx (ClipScore (clip->clip).duration()).epsilon (0.02));
    CHECK (std::ranges::max (curve->y) > 0.5);
    CHECK (std::ranges::max (curve->y) <= 1.0);
    CHECK (std::ranges::min (curve->y) < 0.05);   // the pause
    CHECK (curveOfOne ("signal.clip") == nullptr);
}

TEST_CASE ("the curve of a grating is its force over three ridges, whatever its direction", "[app][canvas][curve]")
{
    for (const double angle : { 0.0, 1.0, -2.0 })
    {
        const auto curve = curveOfOne ("texture.grating", { { "amplitude", 0.4 }, { "spatial_frequency", 500 }, { "angle", angle } });
        REQUIRE (curve);
        CHECK (curve->x.back() == Approx (3.0 / 500.0));
        CHECK (std::ranges::max (curve->y) == Approx (0.4).epsilon (0.01));
        CHECK (std::ranges::min (curve->y) == Approx (-0.4).epsilon (0.01));
        CHECK (curve->quantity == Quantity::force);
    }
    CHECK_FALSE (curveOfOne ("texture.grating", { { "spatial_frequency", 0 } }));
}

TEST_CASE ("the curve of friction shows how it sticks, slides and slips", "[app][canvas][curve]")
{
    const auto plain = curveOfOne ("friction.elasto_plastic", { { "mu", 0.5 }, { "d_max", "1 mm" } });
    REQUIRE (plain);
    CHECK (plain->y.front() == 0.0);
    CHECK (at (*plain, 0.5e-3) == Approx (0.25).epsilon (0.02));
    CHECK (at (*plain, 3e-3) == Approx (0.5).epsilon (0.02));

    // With a static ratio above 1, the force rises above that of sliding and falls back.
    const auto slips = curveOfOne ("friction.elasto_plastic", { { "mu", 0.5 }, { "d_max", "1 mm" }, { "static_ratio", 2 } });
    REQUIRE (slips);
    CHECK (std::ranges::max (slips->y) > 0.9);
    CHECK (at (*slips, 2.2e-3) < 0.75);

    // Dahl creeps from the start.
    const auto dahl = curveOfOne ("friction.elasto_plastic", { { "mu", 0.5 }, { "d_max", "1 mm" }, { "adhesion", "dahl" } });
    REQUIRE (dahl);
    CHECK (at (*dahl, 1e-3) < 0.8 * at (*plain, 1e-3));
}

TEST_CASE ("the curve of a contact window is its gain over the depth", "[app][canvas][curve]")
{
    const auto curve = curveOfOne ("contact.window", { { "window", "2 mm" } });
    REQUIRE (curve);
    CHECK (curve->x.front() < 0.0);
    CHECK (at (*curve, -0.5e-3) == 0.0);
    CHECK (at (*curve, 1e-3) == Approx (0.5).epsilon (0.05));
    CHECK (curve->y.back() == 1.0);
}

TEST_CASE ("laws, curves in use, and modes are shown as the settings give them", "[app][canvas][curve]")
{
    const auto law = curveOfOne ("deform.plane", Json::object(), { { "law", { { "exponential", { 0.2, 900 } } } } });
    REQUIRE (law);
    CHECK (law->y.front() == 0.0);
    CHECK (at (*law, law->x.back() / 2) < 0.3 * law->y.back());
    CHECK_FALSE (curveOfOne ("deform.plane"));   // a straight line says nothing

    const Json table = Json::array ({ Json::array ({ 0, 1 }), Json::array ({ 1, 0.25 }) });
    const auto unused = curveOfOne ("friction.elasto_plastic", { { "d_max", "1 mm" } }, { { "adhesion_curve", table } });
    REQUIRE (unused);
    CHECK (unused->x_unit == "m");
    const auto used = curveOfOne ("friction.elasto_plastic", { { "d_max", "1 mm" }, { "adhesion", "curve" } }, { { "adhesion_curve", table } });
    REQUIRE (used);
    CHECK (used->y == std::vector<double> { 1.0, 0.25 });

    const Json low { { "frequency", 80 }, { "amplitude", 0.2 } }, high { { "frequency", 240 }, { "amplitude", -0.5 } };
    const auto modes = curveOfOne ("vibration.modal", Json::object(), { { "modes", Json::array ({ low, high }) } });
    REQUIRE (modes);
    CHECK (modes->kind == PlotData::Kind::stems);
    CHECK (modes->x == std::vector<double> { 80.0, 240.0 });
    CHECK (modes->y == std::vector<double> { 0.2, 0.5 });
}

TEST_CASE ("a node has a curve only if its output depends on nothing else, and bends", "[app][canvas][curve]")
{
    CHECK (curveOfOne ("signal.abs"));
    CHECK_FALSE (curveOfOne ("signal.gain"));
    for (const auto* with_time : { "filter.one_pole", "signal.slew", "signal.envelope", "signal.delay", "motion.velocity", "contact.impact" })
    {
        INFO (with_time);
        CHECK_FALSE (curveOfOne (with_time));
    }
    CHECK_FALSE (curveOfOne ("no.such"));
}

TEST_CASE ("a node of a plugin that fails has no curve", "[app][canvas][curve]")
{
    auto failing = *catalogue().find ("texture.grating");
    failing.prepare = [] (void*, const Setup&) { throw NodeFault ("it failed"); };
    const auto types = catalogue().with ({ failing });
    const auto g = Sketch {}.node ("one", "texture.grating").graph;
    const auto& node = g.root.nodes.front();
    CHECK_FALSE (curveOf (g, {}, node, faceOf (g, g.root, node, types)));
}

TEST_CASE ("no node of the catalogue has a curve with gaps", "[app][canvas][curve]")
{
    for (const auto& type : catalogue())
    {
        INFO (type.info.id);
        const auto curve = curveOfOne (std::string (type.info.id));
        if (! curve) continue;
        CHECK (curve->x.size() == curve->y.size());
        CHECK (std::ranges::all_of (curve->x, [] (double x) { return std::isfinite (x); }));
        CHECK (std::ranges::all_of (curve->y, [] (double y) { return std::isfinite (y); }));
    }
}

TEST_CASE ("a curve follows its params and settings, and controls", "[app][canvas][curve]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.node ("grain").curve;
    REQUIRE (before);
    rig.document.perform (graph::SetParam { {}, "board", "stiffness", Json ("3 N/mm") });
    CHECK (rig.node ("grain").curve == before);   // the same one: nothing was computed again
    rig.document.perform (graph::SetParam { {}, "grain", "spatial_frequency", Json (400) });
    REQUIRE (rig.node ("grain").curve);
    CHECK (rig.node ("grain").curve->x.back() == Approx (3.0 / 400.0));
    rig.document.undo();
    REQUIRE (rig.node ("grain").curve);
    CHECK (rig.node ("grain").curve->x.back() == Approx (before->x.back()));
}

TEST_CASE ("a node with a curve has room for it below its params", "[app][canvas][curve]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto& grain = rig.node ("grain");
    REQUIRE_FALSE (grain.box.plot.isEmpty());
    for (const auto& s : grain.box.sockets)
        CHECK_FALSE (s.row.intersects (grain.box.plot));
    CHECK (grain.box.plot.getBottom() <= grain.box.height);
    CHECK (rig.node ("hand").box.plot.isEmpty());
}

TEST_CASE ("the nodes of no preset overlap", "[app][canvas]")
{
    for (const auto& entry : std::filesystem::directory_iterator (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        INFO (entry.path().stem());
        CanvasRig rig { CanvasRig::preset (entry.path().stem().string()) };
        const auto& nodes = rig.canvas->scene().nodes();
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t k = i + 1; k < nodes.size(); ++k)
                CHECK_FALSE (nodes[i].bounds().intersects (nodes[k].bounds()));
    }
}
