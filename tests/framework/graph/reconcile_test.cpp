// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/reconcile.hpp>

#include "support/sketch.hpp"
#include "wild_graph.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <set>

using namespace tactus;
using namespace tactus::graph;
using test::Sketch;

namespace
{
Id idOf (const Patch& patch, std::string_view node) { return patch.find (node)->id; }

Wire wire (const std::string& text) { return *parseWire (text); }

std::vector<Id> ids (const Patch& patch)
{
    std::vector<Id> all;
    for (const auto& n : patch.nodes)
        all.push_back (n.id);
    for (const auto& w : patch.wires)
        all.push_back (w.id);
    return all;
}

/// Ids by the name of their node or the text of their wire, regardless of the order in the file.
std::multimap<std::string, Id> identities (const Patch& patch)
{
    std::multimap<std::string, Id> all;
    for (const auto& n : patch.nodes)
        all.emplace (n.name, n.id);
    for (const auto& w : patch.wires)
        all.emplace (toText (w), w.id);
    return all;
}
}   // namespace

TEST_CASE ("a node with the same name and type keeps its id, no matter what else has changed", "[graph]")
{
    const auto before = Sketch {}.node ("a", "signal.gain").node ("b", "signal.abs").node ("c", "signal.gain").graph;
    auto now = Sketch {}.node ("new", "signal.gain").node ("c", "signal.abs").node ("a", "signal.gain", { { "gain", 3.0 } }).graph;
    const auto c = idOf (now.root, "c"), fresh = idOf (now.root, "new");
    reconcile (now, before);
    CHECK (idOf (now.root, "a") == idOf (before.root, "a"));
    CHECK (idOf (now.root, "c") == c);
    CHECK (idOf (now.root, "new") == fresh);
}

TEST_CASE ("wires are matched by text and order, then by their ends", "[graph]")
{
    Graph before, now;
    for (const auto* text : { "a.out -> b.in", "a.out -> [3] -> b.in", "a.out -> b.in", "a.out -> (+) b.gain" })
        before.root.wires.push_back (wire (text));
    for (const auto* text : { "a.out -> [5] -> b.in", "a.out -> b.in", "a.out -> b.gain", "a.out -> b.in", "a.out -> b.in" })
        now.root.wires.push_back (wire (text));
    const auto &was = before.root.wires, &is = now.root.wires;
    const auto own = ids (now.root);
    reconcile (now, before);
    CHECK (is[0].id == was[1].id);
    CHECK (is[1].id == was[0].id);
    CHECK (is[2].id == own[2]);
    CHECK (is[3].id == was[2].id);
    CHECK (is[4].id == own[4]);
}

TEST_CASE ("a delayed wire with the same text is preferred to one with a different delay", "[graph]")
{
    Graph before, now;
    before.root.wires = { wire ("a.out -> [2] -> b.in"), wire ("a.out -> [3] -> b.in") };
    now.root.wires = { wire ("a.out -> [3] -> b.in"), wire ("a.out -> [4] -> b.in") };
    reconcile (now, before);
    CHECK (now.root.wires[0].id == before.root.wires[1].id);
    CHECK (now.root.wires[1].id == before.root.wires[0].id);
}

TEST_CASE ("a file that is shuffled and read again gets all its ids back, including in subgraphs, and none twice", "[graph]")
{
    test::property ("any graph", [] (std::uint64_t seed) {
        const auto before = test::wildGraph (seed);
        auto now = readGraph (writeGraph (before)).graph;
        std::mt19937_64 chance { seed };
        std::ranges::shuffle (now.root.nodes, chance);
        std::ranges::shuffle (now.root.wires, chance);
        std::ranges::shuffle (now.graphs, chance);
        reconcile (now, before);
        RC_ASSERT (identities (now.root) == identities (before.root));
        for (const auto& [name, patch] : now.graphs)
            RC_ASSERT (identities (patch) == identities (*before.find (name)));
        const auto all = ids (now.root);
        RC_ASSERT (std::set (all.begin(), all.end()).size() == all.size());
    });
}

TEST_CASE ("for any two graphs, no id is assigned twice", "[graph]")
{
    test::property ("any two", [] (std::uint64_t a, std::uint64_t b) {
        const auto before = test::wildGraph (a);
        auto now = test::wildGraph (b);
        const auto text = writeGraph (now);
        reconcile (now, before);
        RC_ASSERT (writeGraph (now) == text);
        std::set<Id> all;
        std::size_t count = 0;
        const auto add = [&] (const Patch& patch) {
            const auto some = ids (patch);
            all.insert (some.begin(), some.end());
            count += some.size();
        };
        add (now.root);
        for (const auto& [name, patch] : now.graphs)
            add (patch);
        RC_ASSERT (all.size() == count);
    });
}

TEST_CASE ("included files keep their ids too, and a file that is included twice remains a single file", "[graph]")
{
    const auto grain = [] (double gain) {
        auto inner = Sketch {}.node ("wave", "signal.gain", { { "gain", gain } }).graph;
        auto leaf = std::make_shared<const Graph> (std::move (inner));
        Graph branch[2];
        for (auto& b : branch)
            b.files["leaf.json"] = leaf;
        Graph root;
        root.files["a.json"] = std::make_shared<const Graph> (branch[0]);
        root.files["b.json"] = std::make_shared<const Graph> (branch[1]);
        return root;
    };
    const auto leafOf = [] (const Graph& g, const char* path) { return g.files.at (path)->files.at ("leaf.json"); };

    const auto before = grain (1.0);
    auto now = grain (2.0);
    reconcile (now, before);
    CHECK (idOf (leafOf (now, "a.json")->root, "wave") == idOf (leafOf (before, "a.json")->root, "wave"));
    CHECK (leafOf (now, "a.json")->root.nodes[0].params["gain"] == 2.0);
    CHECK (leafOf (now, "a.json") == leafOf (now, "b.json"));
}

TEST_CASE ("a plan compiled from a file that was read again continues the previous plan bit for bit", "[graph]")
{
    const auto text = [] (const std::string& more) {
        return R"({ "format": "tactus-graph", "version": 1, "nodes": { "one": { "type": "signal.constant", "params": { "value": 1 } }, )" + more
               + R"( "count": { "type": "signal.add" }, "late": { "type": "signal.gain" } },
                   "wires": [ "one.out -> count.in[0]", "count.out -> [1] -> count.in[1]", "count.out -> [4] -> late.in" ] })";
    };
    const auto before = readGraph (text ("")).graph;
    CompileOptions options { .records = { "count.out", "late.out" } };
    Engine engine { compile (before, catalogue(), options).plan };
    for (int k = 0; k < 10; ++k)
        engine.tick();

    auto now = readGraph (text (R"("idle": { "type": "signal.abs" },)")).graph;
    reconcile (now, before);
    options.before = &engine.newest();
    engine.submit (compile (now, catalogue(), options).plan);
    engine.tick();
    CHECK (*engine.plan().taps()[0].value == 11.0);
    CHECK (*engine.plan().taps()[1].value == 7.0);
}
