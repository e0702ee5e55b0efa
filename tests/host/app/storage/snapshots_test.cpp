// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/model/document.hpp>
#include <host/app/storage/snapshots.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/history.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

namespace
{
graph::Graph graphOf (const std::string& name) { return loadGraph (std::string (TACTUS_SOURCE_DIR) + "/graphs/" + name).graph; }

void mustPerform (graph::History& h, graph::Command c)
{
    const auto done = h.perform (std::move (c));
    INFO ((done ? "" : done.error().text));
    REQUIRE (done);
}

graph::Node gainNamed (const char* name, double gain)
{
    graph::Node n;
    n.name = name;
    n.type = "signal.gain";
    n.params["gain"] = gain;
    return n;
}

Json paramsOf (const graph::History& h, const char* node) { return h.graph().root.find (node)->params; }
}   // namespace

TEST_CASE ("a snapshot restores params, defaults and controls in one step")
{
    graph::History h (graphOf ("dry_wood.json"));
    const auto before = paramsOf (h, "drag");
    mustPerform (h, storeSnapshot (h.graph(), 2));
    CHECK (hasSnapshot (h.graph(), 2));
    CHECK_FALSE (hasSnapshot (h.graph(), 1));

    mustPerform (h, graph::SetParam { "", "drag", "mu", Json (0.9) });
    mustPerform (h, graph::SetParam { "", "drag", "stiffness", Json (300.0) });   // the snapshot has the default
    mustPerform (h, graph::SetParam { "", "drag", "d_max", std::nullopt });
    auto rough = h.graph().controls[0];
    rough.value = 0.1;
    mustPerform (h, graph::ChangeControl { rough.id, rough });

    const auto steps = h.position();
    const auto command = recallSnapshot (h.graph(), 2);
    REQUIRE (command);
    mustPerform (h, *command);
    CHECK (h.position() == steps + 1);
    CHECK (h.names().back() == "snapshot 2");
    CHECK (paramsOf (h, "drag") == before);
    CHECK (h.graph().controls[0].value == 0.5);
    CHECK_FALSE (recallSnapshot (h.graph(), 2));   // nothing left to change

    h.undo();
    CHECK (paramsOf (h, "drag")["mu"] == 0.9);
    CHECK (h.graph().controls[0].value == 0.1);
}

TEST_CASE ("a snapshot changes only what still exists, but no wires")
{
    graph::History h (graphOf ("dry_wood.json"));
    mustPerform (h, storeSnapshot (h.graph(), 1));
    mustPerform (h, graph::SetParam { "", "drag", "mu", Json (0.8) });
    mustPerform (h, graph::RemoveNode { "", "grain" });
    graph::Node fresh;
    fresh.name = "fresh";
    fresh.type = "signal.gain";
    fresh.params["gain"] = 3.0;
    mustPerform (h, graph::AddNode { "", fresh });
    const auto wires = h.graph().root.wires.size();
    const auto command = recallSnapshot (h.graph(), 1);
    REQUIRE (command);
    mustPerform (h, *command);
    CHECK (paramsOf (h, "drag")["mu"] == 0.4);
    CHECK (paramsOf (h, "fresh")["gain"] == 3.0);
    CHECK (h.graph().root.find ("grain") == nullptr);
    CHECK (h.graph().root.wires.size() == wires);
}

TEST_CASE ("a node of a different type that has taken over a name keeps its values")
{
    graph::History h (graphOf ("dry_wood.json"));
    mustPerform (h, storeSnapshot (h.graph(), 1));
    mustPerform (h, graph::RemoveNode { "", "drag" });
    graph::Node other;
    other.name = "drag";
    other.type = "signal.gain";
    mustPerform (h, graph::AddNode { "", other });
    CHECK_FALSE (recallSnapshot (h.graph(), 1));
}

TEST_CASE ("snapshots include subgraphs and their overrides, and are saved in the file")
{
    graph::History h (graphOf ("two_fingers.json"));
    REQUIRE_FALSE (h.graph().graphs.empty());
    const auto& [name, patch] = h.graph().graphs.front();
    const auto inner = std::ranges::find_if (patch.nodes, [] (const graph::Node& n) { return ! n.params.empty(); });
    REQUIRE (inner != patch.nodes.end());
    const auto subgraph = name, node = inner->name, key = inner->params.begin().key();
    const auto value = inner->params.begin().value();
    mustPerform (h, storeSnapshot (h.graph(), 9));
    mustPerform (h, graph::SetParam { subgraph, node, key, std::nullopt });

    const auto reread = readGraph (writeGraph (h.graph())).graph;
    CHECK (hasSnapshot (reread, 9));
    const auto command = recallSnapshot (reread, 9);
    REQUIRE (command);
    graph::History again (reread);
    mustPerform (again, *command);
    CHECK (again.graph().find (subgraph)->find (node)->params[key] == value);
}

TEST_CASE ("a snapshot holds the same nodes after they are renamed, grouped and ungrouped", "[snapshots]")
{
    Document document (graphOf ("dry_wood.json"));
    const auto muOf = [&] (const graph::Patch& patch, const char* name) { return patch.find (name)->params["mu"]; };
    const auto recalls = [&] {
        const auto command = recallSnapshot (document.graph(), 1);
        REQUIRE (command);
        REQUIRE (document.perform (*command));
        CHECK (missingNodes (document.graph(), 1).empty());
    };
    REQUIRE (document.perform (storeSnapshot (document.graph(), 1)));
    const auto stored = writeGraph (document.graph());
    const auto steps = document.history().size();

    REQUIRE (document.perform (graph::AddNode { "", gainNamed ("fresh", 3.0) }));
    REQUIRE (document.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    REQUIRE (document.perform (graph::RenameNode { "", "drag", "rubbed" }));
    CHECK (document.history().size() == steps + 3);   // one step each
    CHECK (document.stepName (steps + 2) == "rename 'drag' to 'rubbed'");
    recalls();
    CHECK (muOf (document.graph().root, "rubbed") == 0.4);
    const auto& sources = document.graph().extra["ui"]["sources"];
    CHECK (sources.contains ("rubbed.mu"));
    CHECK_FALSE (sources.contains ("drag.mu"));

    REQUIRE (document.perform (graph::SetParam { "", "rubbed", "mu", Json (0.9) }));
    REQUIRE (document.perform (graph::CollapseNodes { "", { "rubbed", "grain" }, "wood", "wood" }));
    CHECK (document.graph().extra["ui"]["sources"].contains ("wood/rubbed.mu"));
    recalls();
    CHECK (muOf (*document.graph().find ("wood"), "rubbed") == 0.4);

    REQUIRE (document.perform (graph::RenameNode { "wood", "rubbed", "drag" }));
    REQUIRE (document.perform (graph::RenameSubgraph { "wood", "oak" }));
    REQUIRE (document.perform (graph::RenameNode { "", "wood", "oak" }));
    REQUIRE (document.perform (graph::SetParam { "oak", "drag", "mu", Json (0.9) }));
    CHECK (document.graph().extra["ui"]["sources"].contains ("oak/drag.mu"));
    recalls();
    CHECK (muOf (*document.graph().find ("oak"), "drag") == 0.4);

    REQUIRE (document.perform (graph::SetParam { "oak", "drag", "mu", Json (0.9) }));
    REQUIRE (document.perform (graph::ExpandNode { "", "oak" }));
    recalls();
    CHECK (muOf (document.graph().root, "drag") == 0.4);
    CHECK (document.graph().extra["ui"]["sources"].contains ("drag.mu"));

    REQUIRE (document.perform (graph::SetParam { "", "fresh", "gain", Json (5.0) }));   // never in the snapshot
    CHECK_FALSE (recallSnapshot (document.graph(), 1));

    document.goTo (steps);
    CHECK (writeGraph (document.graph()) == stored);
}

TEST_CASE ("a snapshot holds the values of both copies of a shared subgraph that is expanded", "[snapshots]")
{
    Document document (graphOf ("two_fingers.json"));
    graph::Patch patch;
    patch.nodes.push_back (gainNamed ("g", 2.0));
    REQUIRE (document.perform (graph::AddSubgraph { "both", patch }));
    for (const char* name : { "a", "b" })
    {
        graph::Node n;
        n.name = name;
        n.type = "graph:both";
        REQUIRE (document.perform (graph::AddNode { "", n }));
    }
    REQUIRE (document.perform (graph::SetOverride { "", "a", "g.gain", Json (7.0) }));
    REQUIRE (document.perform (storeSnapshot (document.graph(), 4)));
    REQUIRE (document.perform (graph::SetOverride { "", "a", "g.gain", Json (8.0) }));
    REQUIRE (document.perform (graph::ExpandNode { "", "a" }));
    CHECK (document.graph().root.find ("g")->params["gain"] == 8.0);
    const auto command = recallSnapshot (document.graph(), 4);
    REQUIRE (command);
    REQUIRE (document.perform (*command));
    CHECK (document.graph().root.find ("g")->params["gain"] == 7.0);
    CHECK (document.graph().find ("both")->find ("g")->params["gain"] == 2.0);
}

TEST_CASE ("a snapshot names the nodes that the graph no longer has", "[snapshots]")
{
    Document document (graphOf ("dry_wood.json"));
    REQUIRE (document.perform (storeSnapshot (document.graph(), 1)));
    CHECK (missingNodes (document.graph(), 1).empty());
    REQUIRE (document.perform (graph::RemoveNode { "", "grain" }));
    CHECK (missingNodes (document.graph(), 1) == std::vector<std::string> { "grain" });
}

TEST_CASE ("storing a snapshot keeps the rest of `ui`, and can be undone")
{
    graph::History h (graphOf ("dry_wood.json"));
    const auto before = writeGraph (h.graph());
    const auto sources = h.graph().extra["ui"]["sources"];
    mustPerform (h, storeSnapshot (h.graph(), 4));
    CHECK (h.graph().extra["ui"]["sources"] == sources);
    CHECK (h.names().back() == "store snapshot 4");
    h.undo();
    CHECK (writeGraph (h.graph()) == before);
}

TEST_CASE ("malformed snapshots in a file do no harm")
{
    for (const auto* ui : { R"({"snapshots": 3})", R"({"snapshots": {"1": []}})", R"({"snapshots": {"1": {"nodes": 7, "controls": [1], "graphs": null}}})",
                            R"({"snapshots": {"1": {"nodes": {"drag": {"type": "friction.elasto_plastic", "params": 5, "overrides": "x"}},
                                                    "controls": {"roughness": "much"}}}})" })
    {
        auto g = graphOf ("dry_wood.json");
        g.extra["ui"] = Json::parse (ui);
        CHECK_FALSE (recallSnapshot (g, 1));
        CHECK_FALSE (hasSnapshot (g, 2));
        graph::History h (g);
        mustPerform (h, storeSnapshot (h.graph(), 1));
        CHECK (hasSnapshot (h.graph(), 1));
    }
}

TEST_CASE ("a graph is at a snapshot exactly if recalling it changes nothing", "[snapshots]")
{
    for (const auto* name : { "dry_wood.json", "layered_cloth.json", "liver.json" })
    {
        INFO (name);
        graph::History h (graphOf (name));
        CHECK_FALSE (isAtSnapshot (h.graph(), 1));   // there is none
        mustPerform (h, storeSnapshot (h.graph(), 1));
        CHECK (isAtSnapshot (h.graph(), 1));
        std::vector<graph::Command> edits;
        for (const auto& c : h.graph().controls)
        {
            auto to = c;
            to.value = c.value < 0.5 ? 0.9 : 0.1;
            edits.emplace_back (graph::ChangeControl { c.id, to });
        }
        const auto change = [&] (const std::string& patch, const graph::Patch& in) {
            for (const auto& n : in.nodes)
            {
                if (! n.params.empty()) edits.emplace_back (graph::SetParam { patch, n.name, n.params.items().begin()->first, std::nullopt });
                if (! n.overrides.empty()) edits.emplace_back (graph::SetOverride { patch, n.name, n.overrides.items().begin()->first, std::nullopt });
            }
        };
        change ({}, h.graph().root);
        for (const auto& [patch, in] : h.graph().graphs)
            change (patch, in);
        CHECK (edits.size() > 1);
        for (const auto& edit : edits)
        {
            mustPerform (h, edit);
            CHECK_FALSE (isAtSnapshot (h.graph(), 1));
            CHECK (recallSnapshot (h.graph(), 1));
            h.undo();
            CHECK (isAtSnapshot (h.graph(), 1));
        }
        mustPerform (h, graph::RemoveNode { {}, h.graph().root.nodes.front().name });
        CHECK (isAtSnapshot (h.graph(), 1) == ! recallSnapshot (h.graph(), 1).has_value());
    }
}
