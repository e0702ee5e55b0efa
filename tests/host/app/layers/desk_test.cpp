// SPDX-License-Identifier: MIT
#include <host/app/layers/desk.hpp>

#include <framework/file/graph_file.hpp>
#include <framework/graph/history.hpp>
#include <framework/plan/compile.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <numeric>

using namespace tactus;
using namespace tactus::host;

namespace
{
graph::Graph bell() { return loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph; }

bool compiles (const graph::Graph& g)
{
    const auto compiled = compile (g, catalogue());
    for (const auto& m : compiled.messages)
        if (m.severity == Message::Severity::error) UNSCOPED_INFO (m.where << ": " << m.text);
    return compiled.plan != nullptr;
}

std::vector<std::string> sources (const graph::Graph& g, const DeskPlace& desk)
{
    std::vector<std::string> all;
    for (int i = 0; i < layersOf (*findDesk (g, desk), catalogue()); ++i)
    {
        const auto* w = wireInto (g, desk, i);
        all.push_back (w == nullptr ? "" : w->from.node);
    }
    return all;
}

/// What belongs together of each layer: its source, its name, its gain, and the control that sets that.
std::vector<std::string> channels (const graph::Graph& g, const DeskPlace& desk)
{
    const auto& node = *findDesk (g, desk);
    const int n = layersOf (node, catalogue());
    auto all = sources (g, desk);
    const auto names = layerNames (node, n);
    for (int i = 0; i < n; ++i)
    {
        auto& text = all[static_cast<std::size_t> (i)];
        text += '|' + names[static_cast<std::size_t> (i)] + '|' + layerValue (node, catalogue(), "gain", i).dump() + '|';
        for (const auto& c : g.controls)
            for (const auto& t : c.to)
                if (t.path == desk.path + ".gain[" + std::to_string (i) + ']') text += c.id;
    }
    return all;
}
}   // namespace

TEST_CASE ("the desks of a graph are found, also those inside subgraphs, each once", "[layers]")
{
    test::Sketch sketch;
    sketch.node ("a", "layer.mix").node ("first", "graph:inner").node ("second", "graph:inner");
    sketch.add (sketch.subgraph ("inner"), "mix", "layer.mix");
    const auto desks = desksOf (sketch.graph);
    REQUIRE (desks.size() == 2);
    CHECK (desks[0].path == "a");
    CHECK (desks[1].path == "first/mix");
    CHECK (desks[1].patch == "inner");
    CHECK (findDesk (sketch.graph, desks[1])->type == "layer.mix");
}

TEST_CASE ("a layer that goes takes its wires along, the others keep what is theirs, and undo brings it all back", "[layers]")
{
    graph::History history (bell());
    const auto before = writeGraph (history.graph());
    const auto desk = desksOf (history.graph()).front();
    const auto all = channels (history.graph(), desk);
    REQUIRE (all == std::vector<std::string> { "blow|blow|1|blow", "ring_felt|ring|1|ring", "warble_felt|warble|0.5|warble" });

    auto command = removeLayer (history.graph(), desk, catalogue(), 1);
    REQUIRE (std::holds_alternative<graph::Command> (command));
    CHECK_FALSE (history.perform (std::get<graph::Command> (command)));
    CHECK (channels (history.graph(), desk) == std::vector<std::string> { all[0], all[2] });
    CHECK (history.graph().controls[1].to.empty());
    CHECK (compiles (history.graph()));
    CHECK (history.names().size() == 1);
    history.undo();
    CHECK (writeGraph (history.graph()) == before);
}

TEST_CASE ("the last layer stays, and so does one that a subgraph shows", "[layers]")
{
    test::Sketch sketch;
    sketch.node ("a", "graph:inner").node ("one", "layer.mix", Json::object(), { { "inputs", 1 } });
    auto& inner = sketch.subgraph ("inner");
    sketch.add (inner, "mix", "layer.mix");
    inner.expose.inputs.emplace_back ("x", graph::Endpoint { "mix", "in", 1, -1 });
    const auto desks = desksOf (sketch.graph);
    REQUIRE (desks.size() == 2);
    CHECK (std::holds_alternative<std::string> (removeLayer (sketch.graph, desks[0], catalogue(), 1)));
    CHECK (std::holds_alternative<graph::Command> (removeLayer (sketch.graph, desks[0], catalogue(), 0)));
    CHECK (std::holds_alternative<std::string> (removeLayer (sketch.graph, desks[1], catalogue(), 0)));
}

TEST_CASE ("a layer that is moved keeps all that is its own, and moved back the file is as it was", "[layers]")
{
    CHECK (rc::check ([]
                      {
        graph::History history (bell());
        const auto before = writeGraph (history.graph());
        const auto desk = desksOf (history.graph()).front();
        auto all = channels (history.graph(), desk);
        const auto from = *rc::gen::inRange (0, 3), to = *rc::gen::inRange (0, 3);
        RC_ASSERT (! history.perform (moveLayer (history.graph(), desk, catalogue(), from, to)));
        const auto moved = all[static_cast<std::size_t> (from)];
        all.erase (all.begin() + from);
        all.insert (all.begin() + to, moved);
        RC_ASSERT (channels (history.graph(), desk) == all);
        RC_ASSERT (! history.perform (moveLayer (history.graph(), desk, catalogue(), to, from)));
        RC_ASSERT (writeGraph (history.graph()) == before); }));
}

TEST_CASE ("every texture and vibration that can be a layer is added, wired, and runs", "[layers]")
{
    REQUIRE (layerTypes (catalogue()).size() >= 4);
    for (const auto* type : layerTypes (catalogue()))
    {
        INFO (type->info.id);
        graph::History history (bell());
        const auto desk = desksOf (history.graph()).front();
        auto added = addLayer (history.graph(), desk, catalogue(), std::string (type->info.id));
        REQUIRE (std::holds_alternative<AddedLayer> (added));
        REQUIRE_FALSE (history.perform (std::get<AddedLayer> (added).command));
        CHECK (layersOf (*findDesk (history.graph(), desk), catalogue()) == 4);
        CHECK (sources (history.graph(), desk).back() != "");
        CHECK (compiles (history.graph()));
        int inputs = 0;
        for (const auto& w : history.graph().root.wires)
            if (w.to.node == sources (history.graph(), desk).back()) ++inputs;
        CHECK (inputs + (std::get<AddedLayer> (added).misses.empty() ? 0 : 1) >= static_cast<int> (type->inputs.size()));
    }
}

TEST_CASE ("what a new layer is fed with never waits for the desk itself", "[layers]")
{
    test::Sketch sketch;
    sketch.node ("desk", "layer.mix").node ("late", "contact.impact").wire ("desk.out -> late.depth");
    sketch.graph.root.wires.clear();
    sketch.node ("map", "signal.gain").wire ("desk.out -> map.in").wire ("map.out -> late.depth");
    const auto desk = desksOf (sketch.graph).front();
    auto added = addLayer (sketch.graph, desk, catalogue(), "vibration.modal");
    REQUIRE (std::holds_alternative<AddedLayer> (added));
    CHECK (std::get<AddedLayer> (added).misses.find (".hit") != std::string::npos);
}

TEST_CASE ("a desk goes between scalar forces and the motor, and beside vectors", "[layers]")
{
    graph::History joined (loadGraph (TACTUS_SOURCE_DIR "/graphs/steel_bar.json").graph);
    auto between = addDesk (joined.graph(), catalogue());
    REQUIRE (std::holds_alternative<AddedDesk> (between));
    REQUIRE_FALSE (joined.perform (std::get<AddedDesk> (between).command));
    const auto desk = desksOf (joined.graph()).front();
    for (const auto& s : sources (joined.graph(), desk))
        CHECK (s != "");
    CHECK (compiles (joined.graph()));
    CHECK (joined.names().size() == 1);

    graph::History vectors (loadGraph (TACTUS_SOURCE_DIR "/graphs/layered_cloth.json").graph);
    auto beside = addDesk (vectors.graph(), catalogue());
    REQUIRE (std::holds_alternative<AddedDesk> (beside));
    REQUIRE_FALSE (vectors.perform (std::get<AddedDesk> (beside).command));
    CHECK (compiles (vectors.graph()));

    CHECK (std::holds_alternative<std::string> (addDesk ({}, catalogue())));
}

TEST_CASE ("every graph that is delivered with a motor takes a desk, and still runs", "[layers]")
{
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        INFO (entry.path());
        graph::History history (loadGraph (entry.path()).graph);
        auto added = addDesk (history.graph(), catalogue());
        if (std::holds_alternative<std::string> (added)) continue;
        REQUIRE_FALSE (history.perform (std::get<AddedDesk> (added).command));
        const auto messages = compile (history.graph(), catalogue()).messages;
        for (const auto& m : messages)
            if (m.severity == Message::Severity::error) CHECK (m.id.starts_with ("setting"));   // files are not read here
    }
}

TEST_CASE ("values of layers are set one by one, and a list of defaults is not written", "[layers]")
{
    graph::History history (bell());
    const auto desk = desksOf (history.graph()).front();
    const auto node = [&]() -> const graph::Node&
    { return *findDesk (history.graph(), desk); };
    REQUIRE_FALSE (history.perform (setLayerValue (node(), desk, catalogue(), "mute", 2, Json (1))));
    CHECK (node().params["mute"].dump() == "[0.0,0.0,1]");
    CHECK (layerValue (node(), catalogue(), "mute", 2) == 1);
    CHECK (layerValue (node(), catalogue(), "mute", 0) == 0.0);
    REQUIRE_FALSE (history.perform (setLayerValue (node(), desk, catalogue(), "mute", 2, std::nullopt)));
    CHECK_FALSE (node().params.contains ("mute"));
    REQUIRE_FALSE (history.perform (renameLayer (node(), desk, 3, 1, " hum, deep ")));
    CHECK (layerNames (node(), 3) == std::vector<std::string> { "blow", "hum  deep", "warble" });
}

TEST_CASE ("where the motors are inside a subgraph, one is told where a desk goes", "[layers]")
{
    const auto why = addDesk (loadGraph (TACTUS_SOURCE_DIR "/graphs/two_fingers.json").graph, catalogue());
    REQUIRE (std::holds_alternative<std::string> (why));
    CHECK (std::get<std::string> (why).find ("subgraph") != std::string::npos);
}
