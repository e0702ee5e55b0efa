// SPDX-License-Identifier: MIT
// Each step of the migration changes a graph file as intended, and files of the newest version stay as they are.
#include <tactus/file/graph_file.hpp>

#include <support/temporary_folder.hpp>
#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;

namespace
{
std::string file (int version, const std::string& members)
{
    return R"({ "format": "tactus-graph", "version": )" + std::to_string (version) + ", " + members + " }";
}

/// The `load` of a node, as text; empty if the file does not give it.
std::string loadOf (const graph::Patch& patch, const std::string& node)
{
    const auto& params = patch.find (node)->params;
    return params.contains ("load") ? params["load"].asString() : std::string();
}

/// The `crease` of a node, in degrees; 0 if the file does not give it.
double creaseOf (const graph::Patch& patch, const std::string& node)
{
    const auto& settings = patch.find (node)->settings;
    return settings.contains ("crease") ? settings["crease"].get<double>() : 0.0;
}

const std::string bodies = R"("nodes": {
    "silent": { "type": "deform.surface", "settings": { "scale": "1 mm" } },
    "bare": { "type": "deform.surface" },
    "printed": { "type": "deform.surface", "settings": { "crease": 20 } },
    "plane": { "type": "deform.plane" },
    "part": { "type": "graph:part" } },
  "graphs": { "part": { "nodes": { "silent": { "type": "deform.surface" } }, "wires": [] } })";

const std::string contacts = R"("nodes": {
    "silent": { "type": "friction.elasto_plastic", "params": { "mu": 0.3 } },
    "bare": { "type": "friction.elasto_plastic" },
    "printed": { "type": "friction.elasto_plastic", "params": { "load": "scale" } },
    "gain": { "type": "signal.gain" },
    "part": { "type": "graph:part", "overrides": { "silent.mu": 0.1 } } },
  "graphs": { "part": { "nodes": { "silent": { "type": "friction.elasto_plastic" } }, "wires": [] } })";
}   // namespace

TEST_CASE ("friction without load in a file of version 1 keeps load passive, in subgraphs too")
{
    const auto loaded = readGraph (file (1, contacts));
    CHECK (loaded.messages.empty());
    const auto& g = loaded.graph;
    CHECK (loadOf (g.root, "silent") == "passive");
    CHECK (loadOf (g.root, "bare") == "passive");
    CHECK (loadOf (g.root, "printed") == "scale");
    CHECK (g.root.find ("gain")->params.empty());
    CHECK (loadOf (*g.find ("part"), "silent") == "passive");
    CHECK (g.root.find ("part")->overrides.size() == 1);
}

TEST_CASE ("friction without load in a file of version 2 is not changed, and uses load bound")
{
    const auto loaded = readGraph (file (2, contacts));
    CHECK (loaded.messages.empty());
    for (const auto* node : { "silent", "bare" })
        CHECK (loadOf (loaded.graph.root, node).empty());

    const auto& params = catalogue().find ("friction.elasto_plastic")->params;
    const auto load = std::ranges::find (params, "load", &PortSheet::id);
    CHECK (load->choices[static_cast<std::size_t> (load->initial[0])] == "bound");
}

TEST_CASE ("a surface without crease in a file of version 1 keeps round edges, in subgraphs too")
{
    const auto loaded = readGraph (file (1, bodies));
    CHECK (loaded.messages.empty());
    const auto& g = loaded.graph;
    CHECK (creaseOf (g.root, "silent") == 180.0);
    CHECK (creaseOf (g.root, "bare") == 180.0);
    CHECK (creaseOf (g.root, "printed") == 20.0);
    CHECK (! g.root.find ("plane")->settings.contains ("crease"));
    CHECK (creaseOf (*g.find ("part"), "silent") == 180.0);
    CHECK (g.root.find ("silent")->settings.contains ("scale"));
}

TEST_CASE ("a surface without crease in a file of version 2 is not changed, and has sharp edges above 30 degrees")
{
    const auto loaded = readGraph (file (2, bodies));
    CHECK (loaded.messages.empty());
    for (const auto* node : { "silent", "bare" })
        CHECK (creaseOf (loaded.graph.root, node) == 0.0);

    const auto& settings = catalogue().find ("deform.surface")->settings;
    CHECK (std::get<double> (std::ranges::find (settings, "crease", &SettingSheet::id)->initial) == 30.0);
}

TEST_CASE ("a file of version 1 is saved as version 2, and then stays the same byte for byte")
{
    const auto saved = writeGraph (readGraph (file (1, contacts)).graph);
    CHECK (saved.find ("\"version\": 2,") != std::string::npos);
    const auto again = readGraph (saved);
    CHECK (again.messages.empty());
    CHECK (writeGraph (again.graph) == saved);
    CHECK (loadOf (again.graph.root, "silent") == "passive");
}

TEST_CASE ("each included file is migrated by its own version")
{
    const TemporaryFolder folder;
    const std::string drag = R"("nodes": { "drag": { "type": "friction.elasto_plastic" } })";
    folder.write ("old.json", file (1, drag));
    folder.write ("new.json", file (2, drag));
    folder.write ("main.json", file (1, R"("nodes": { "a": { "type": "file:old.json" }, "b": { "type": "file:new.json" } })"));
    const auto loaded = loadGraph (folder / "main.json");
    REQUIRE (loaded.messages.empty());
    CHECK (loadOf (loaded.graph.files.at ("old.json")->root, "drag") == "passive");
    CHECK (loadOf (loaded.graph.files.at ("new.json")->root, "drag").empty());
}

TEST_CASE ("parts of version 1 that have the wrong shape are reported by the reader, not by the migration")
{
    for (const auto* members : { R"("nodes": 3)", R"("nodes": { "a": 3 })", R"("nodes": { "a": { "type": 3 } })", R"("graphs": { "g": [] })",
                                 R"("nodes": { "a": { "type": "friction.elasto_plastic", "params": [] } })",
                                 R"("nodes": { "a": { "type": "deform.surface", "settings": 3 } })" })
    {
        const auto messages = readGraph (file (1, members)).messages;
        INFO (members);
        REQUIRE (messages.size() == 1);
        CHECK (messages[0].id == "file/wrong_kind");
    }
}
