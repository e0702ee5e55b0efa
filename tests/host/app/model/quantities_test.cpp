// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/sketch.hpp"

#include <host/app/model/param_now.hpp>
#include <host/app/model/quantities.hpp>
#include <host/app/model/quantity_text.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace tactus;
using namespace tactus::host;
using tactus::test::Sketch;

TEST_CASE ("the quantity of a generic port propagates into and out of a subgraph", "[quantities]")
{
    Sketch sketch;
    auto& louder = sketch.subgraph ("louder");
    sketch.add (louder, "times", "signal.gain");
    louder.expose.inputs = { { "in", { "times", "in" } } };
    louder.expose.outputs = { { "out", { "times", "out" } } };
    sketch.node ("plane", "deform.plane").node ("more", "graph:louder").node ("half", "signal.gain");
    sketch.wire ("plane.resistance -> more.in").wire ("more.out -> half.in");

    const Quantities quantities (sketch.graph, catalogue());
    CHECK (quantities.of (sketch.graph.root, 1, Role::input, "in") == Quantity::force);
    CHECK (quantities.of (sketch.graph.root, 1, Role::output, "out") == Quantity::force);
    CHECK (quantities.of (sketch.graph.root, 2, Role::output, "out") == Quantity::force);
    CHECK (quantities.of (*sketch.graph.find ("louder"), 0, Role::output, "out") == Quantity::force);
    CHECK (quantities.of (*sketch.graph.find ("louder"), 0, Role::param, "gain") == Quantity::gain);
    CHECK (quantities.of (sketch.graph.root, 0, Role::output, "no such port") == Quantity::any);
}

TEST_CASE ("a Scale carries what it scales, as long as its factor has no unit", "[quantities]")
{
    Sketch sketch;
    sketch.node ("hand", "device.position").node ("plane", "deform.plane").node ("touch", "contact.window");
    sketch.node ("a", "vector.scale").node ("b", "vector.scale");
    sketch.wire ("plane.force -> a.in").wire ("a.out -> b.in");
    const auto outputOf = [&] (std::size_t node) { return Quantities (sketch.graph, catalogue()).of (sketch.graph.root, node, Role::output, "out"); };
    CHECK (outputOf (3) == Quantity::force);
    CHECK (outputOf (4) == Quantity::force);
    sketch.wire ("touch.gain -> a.gain");
    CHECK (outputOf (4) == Quantity::force);
    sketch.wire ("plane.depth -> b.gain");   // N m
    CHECK (outputOf (3) == Quantity::force);
    CHECK (outputOf (4) == Quantity::any);
}

TEST_CASE ("a factor that is wired first does not say what a Scale scales", "[quantities]")
{
    Sketch sketch;
    sketch.node ("plane", "deform.plane").node ("touch", "contact.window").node ("scale", "vector.scale");
    const auto of = [&] (Role role, const char* port) { return Quantities (sketch.graph, catalogue()).of (sketch.graph.root, 2, role, port); };
    sketch.wire ("touch.gain -> scale.gain");
    CHECK (of (Role::input, "gain") == Quantity::gain);
    CHECK (of (Role::input, "in") == Quantity::any);   // so a force can be wired to it
    sketch.wire ("plane.force -> scale.in");
    CHECK (of (Role::input, "gain") == Quantity::gain);
    CHECK (of (Role::output, "out") == Quantity::force);
}

TEST_CASE ("a subgraph that contains itself does not hang the propagation", "[quantities]")
{
    Sketch sketch;
    auto& inside = sketch.subgraph ("again");
    sketch.add (inside, "a", "graph:again");
    inside.expose.outputs = { { "out", { "a", "out" } } };
    sketch.node ("top", "graph:again");
    CHECK (Quantities (sketch.graph, catalogue()).of (sketch.graph.root, 0, Role::output, "out") == Quantity::any);
}

TEST_CASE ("the quantity of every wired subgraph port of the presets is known", "[quantities]")
{
    int seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        const auto graph = loadGraph (entry.path()).graph;
        const Quantities quantities (graph, catalogue());
        for (const auto& wire : graph.root.wires)
            for (std::size_t i = 0; i < graph.root.nodes.size(); ++i)
            {
                const auto& node = graph.root.nodes[i];
                if (! node.type.starts_with ("graph:") || node.name != wire.from.node) continue;
                INFO (entry.path().filename() << ": " << node.name << "." << wire.from.port);
                CHECK (quantities.of (graph.root, i, Role::output, wire.from.port) != Quantity::any);
                ++seen;
            }
    }
    CHECK (seen >= 2);
}

TEST_CASE ("a number is shown with six digits, and a whole one with all, so the last bits of a sum are not seen", "[app][units]")
{
    CHECK (shownQuantity (0.1 + 0.2, "1") == "0.3");
    CHECK (shownQuantity (0.1 + 0.2, "rad") == "0.3 rad");
    CHECK (shownQuantity (1.0 / 3.0, "m") == "333.333 mm");
    CHECK (shownQuantity (4294967295.0, "1") == "4294967295");
    CHECK (gainText (Json (0.1 + 0.2)) == "0.3");
}

TEST_CASE ("a length is shown in one way everywhere, as 100 µm and not as 0.0001 m", "[app][units]")
{
    CHECK (shownQuantity (1e-4, "m") == "100 µm");
    CHECK (shownQuantity (0.4, "m") == "400 mm");
    CHECK (shownQuantity (0.06, "N") == "60 mN");
    CHECK (shownQuantity (2500.0, "N/m") == "2500 N/m");
    CHECK (shownQuantity (0.3, "1") == "0.3");
    CHECK (shownQuantity (0.0, "m") == "0 m");
    CHECK (unitShown ("um") == "µm");
    CHECK (unitShown ("mm") == "mm");
    CHECK (unitShown ("N*s/m") == "N·s/m");
    const auto& params = catalogue().find ("friction.elasto_plastic")->params;
    const auto& sheet = *std::ranges::find (params, std::string_view ("d_max"), &PortSheet::id);
    const auto shown = withBestPrefix (*readQuantity (Json (1e-4), sheet), sheet);
    CHECK (shown.toText() == "100 um");   // as files have it
    CHECK (shown.si() == Approx (1e-4));
    CHECK (withBestPrefix (*readQuantity (Json ("0.1 mm"), sheet), sheet).toText() == "0.1 mm");   // a unit that was typed stays
}
