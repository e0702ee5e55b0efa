// SPDX-License-Identifier: MIT
#include "edit_rig.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::graph;
using namespace tactus::test;

TEST_CASE ("when nodes are collapsed to a subgraph, all references to them follow")
{
    auto g = woodGraph();
    const auto drag = g.root.find ("drag")->id;
    const auto ends_inside = g.root.wires[0].id;
    perform (g, CollapseNodes { "", { "drag", "grain" }, "wood", "block" });
    REQUIRE (g.root.nodes.size() == 3);
    CHECK (g.root.nodes[1].name == "wood");
    CHECK (g.root.nodes[1].type == "graph:block");
    const auto* block = g.find ("block");
    REQUIRE (block);
    CHECK (block->find ("drag")->id == drag);
    CHECK (g.root.wires[0].id == ends_inside);
    CHECK (toText (g.root.wires[0]) == "hand.position -> wood.position");
    CHECK (toText (g.root.wires[1]) == "hand.position -> wood.grain_position");
    CHECK (toText (g.root.wires[2]) == "wood.force -> motor.force");
    CHECK (toText (g.root.wires[3]) == "wood.grain_force -> motor.force");
    CHECK (toText (block->expose.inputs[1].second) == "grain[1]/wave.position");
    CHECK (g.controls[0].to[0].path == "wood/grain/wave.amplitude");
    CHECK (g.controls[0].to[1].path == "wood/drag.mu");

    perform (g, CollapseNodes { "grain", { "wave" }, "inner", "wavelet" });
    CHECK (toText (g.find ("grain")->wires[0]) == "inner.value -> gain.in");
    CHECK (toText (g.find ("grain")->expose.inputs[0].second) == "inner.position");
    CHECK (toText (g.find ("wavelet")->expose.inputs[0].second) == "wave.position");
    CHECK (g.controls[0].to[0].path == "wood/grain/inner/wave.amplitude");
    CHECK (g.find ("block")->find ("grain")->overrides.contains ("[1]/inner/wave.angle"));
    CHECK (toText (g.find ("block")->expose.inputs[1].second) == "grain[1]/inner/wave.position");

    perform (g, ExpandNode { "grain", "inner" });
    perform (g, ExpandNode { "", "wood" });
    CHECK (g.find ("block") == nullptr);
    CHECK (g.find ("wavelet") == nullptr);
    CHECK (g.root.find ("drag")->id == drag);
    auto as_it_was = woodGraph();
    const auto wiresOf = [] (const Graph& graph) {
        std::vector<std::string> all;
        for (const auto& w : graph.root.wires)
            all.push_back (toText (w));
        std::ranges::sort (all);
        return all;
    };
    CHECK (wiresOf (g) == wiresOf (as_it_was));
    CHECK (g.controls[0].to[0].path == "grain/wave.amplitude");
    CHECK (g.root.find ("grain")->overrides == as_it_was.root.find ("grain")->overrides);
}

TEST_CASE ("a param to which a wire adds becomes a param of the subgraph, alone if it is an entry of a list, and comes back when it is expanded")
{
    auto g = woodGraph();
    g.root.nodes.push_back (node ("mix"));
    g.root.nodes.back().type = "layer.mix";
    g.root.nodes.push_back (node ("lfo"));
    g.root.nodes.back().type = "signal.lfo";
    for (const auto* text : { "lfo.out -> (+) drag.mu", "lfo.out -> (+) mix.gain[2]", "lfo.out -> drag.d_max" })
        g.root.wires.push_back (wire (text));
    const auto wires = [&] {
        std::vector<std::string> all;
        for (auto w = g.root.wires.end() - 3; w != g.root.wires.end(); ++w)
            all.push_back (toText (*w));
        return all;
    };
    const auto before = wires();
    perform (g, CollapseNodes { "", { "drag", "mix" }, "block", "block" });
    CHECK (wires() == std::vector<std::string> { "lfo.out -> (+) block.mu", "lfo.out -> (+) block.gain", "lfo.out -> block.d_max" });
    const auto& shown = g.find ("block")->expose;
    CHECK (shown.params == std::vector<std::pair<std::string, Endpoint>> { { "mu", { "drag", "mu" } }, { "gain", { "mix", "gain", 2 } } });
    CHECK (std::ranges::count (shown.inputs, "d_max", &std::pair<std::string, Endpoint>::first) == 1);

    perform (g, CollapseNodes { "", { "block" }, "outer", "outer" });
    CHECK (wires() == std::vector<std::string> { "lfo.out -> (+) outer.mu", "lfo.out -> (+) outer.gain", "lfo.out -> outer.d_max" });
    perform (g, ExpandNode { "", "outer" });
    perform (g, ExpandNode { "", "block" });
    CHECK (wires() == before);
}

TEST_CASE ("expanding applies params, overrides and roles to the inner nodes, and keeps a shared subgraph")
{
    auto loaded = readGraph (R"({ "format": "tactus-graph", "version": 1,
  "nodes": {
    "amp": { "type": "signal.gain" },
    "a": { "type": "graph:pair", "params": { "factor": 3 }, "overrides": { "deep/amp.gain": 4, "amp.bias": 5 }, "roles": { "tip": "thumb" } },
    "b": { "type": "graph:pair" }
  },
  "wires": [ "amp.out -> a.x", "a.y -> b.x", "a/deep/amp.out -> amp.bias" ],
  "controls": { "loud": { "value": 0.5, "to": { "a.factor": [0, 1], "a/deep/amp.bias": [0, 1] } } },
  "graphs": {
    "pair": { "nodes": { "amp": { "type": "signal.gain", "params": { "gain": 1 } }, "hand": { "type": "device.position", "role": "tip" },
              "deep": { "type": "graph:deep", "overrides": { "amp.gain": 2 } } },
      "wires": [ "amp.out -> deep.x" ],
      "expose": { "inputs": { "x": "amp.in" }, "outputs": { "y": "deep/amp.out" }, "params": { "factor": "amp.gain" } } },
    "deep": { "nodes": { "amp": { "type": "signal.gain" } }, "expose": { "inputs": { "x": "amp.in" } } } } })");
    REQUIRE (loaded.messages.empty());
    auto g = std::move (loaded.graph);
    const auto shared = g.find ("pair")->nodes[0].id;

    perform (g, ExpandNode { "", "a" });
    REQUIRE (g.root.find ("a_amp"));
    CHECK (g.root.find ("a_amp")->params == Json { { "gain", 3 }, { "bias", 5 } });
    CHECK (g.root.find ("deep")->overrides == Json { { "amp.gain", 4 } });
    CHECK (g.root.find ("hand")->role == "thumb");
    CHECK (g.root.find ("deep")->roles == Json { { "tip", "thumb" } });
    CHECK (toText (g.root.wires[0]) == "amp.out -> a_amp.in");
    CHECK (toText (g.root.wires[1]) == "deep/amp.out -> b.x");
    CHECK (toText (g.root.wires[2]) == "deep/amp.out -> amp.bias");
    CHECK (toText (g.root.wires[3]) == "a_amp.out -> deep.x");
    CHECK (g.controls[0].to[0].path == "a_amp.gain");
    CHECK (g.controls[0].to[1].path == "deep/amp.bias");
    REQUIRE (g.find ("pair"));
    CHECK (g.find ("pair")->nodes[0].id == shared);
    CHECK (g.root.find ("a_amp")->id != shared);
    CHECK (g.root.find ("a_amp")->origin.back().id == shared);

    perform (g, ExpandNode { "", "b" });
    CHECK (g.find ("pair") == nullptr);
    CHECK (g.root.find ("b_amp")->id == shared);
}

TEST_CASE ("a node with a count expands to one node per instance, and all references follow")
{
    auto g = woodGraph();
    perform (g, SetNodeKey { "", "grain", "roles", Json { { "tip", Json::array ({ "thumb", "index" }) }, { "base", "palm" } } });
    perform (g, SetNodeKey { "", "grain", "ui", Json { { "at", 1 } } });
    g.controls[0].to.push_back ({ "grain[1]/wave.phase", 3, 4 });
    const auto grain = g.root.find ("grain")->id;
    const auto force = g.root.wires[3].id, single = g.root.wires[1].id;
    perform (g, ExpandNode { "", "grain" });

    REQUIRE (g.root.nodes.size() == 5);
    CHECK (g.root.nodes[2].name == "grain_0");
    CHECK (g.root.nodes[3].name == "grain_1");
    for (int k = 0; k < 2; ++k)
    {
        const auto& one = g.root.nodes[static_cast<std::size_t> (2 + k)];
        CHECK (one.type == "graph:grain");
        CHECK (one.extra == Json { { "ui", { { "at", 1 } } } });
        CHECK (one.origin == std::vector { Ancestor { grain, k } });
        CHECK (one.roles == Json { { "tip", k == 0 ? "thumb" : "index" }, { "base", "palm" } });
        CHECK (one.overrides == (k == 0 ? Json { { "wave.phase", 1 } } : Json { { "wave.phase", 1 }, { "wave.angle", 2 } }));
    }
    REQUIRE (g.root.wires.size() == 5);
    CHECK (toText (g.root.wires[1]) == "hand.position -> grain_1/wave.position");
    CHECK (g.root.wires[1].id == single);
    CHECK (toText (g.root.wires[3]) == "grain_0.force -> motor.force");
    CHECK (toText (g.root.wires[4]) == "grain_1.force -> motor.force");
    CHECK (g.root.wires[4].origin == std::vector { Ancestor { force } });
    std::vector<std::string> targets;
    for (const auto& t : g.controls[0].to)
        targets.push_back (t.path);
    CHECK (targets == std::vector<std::string> { "grain_0/wave.amplitude", "grain_1/wave.amplitude", "drag.mu", "grain_1/wave.phase" });

    perform (g, ExpandNode { "", "grain_1" });
    CHECK (g.root.find ("wave")->params == Json { { "phase", 1 }, { "angle", 2 } });
    CHECK (g.root.find ("wave")->origin.front() == Ancestor { grain, 1 });
}

TEST_CASE ("instances inside a subgraph are expanded in all references through it, unless it exposes them together")
{
    auto g = woodGraph();
    g.graphs.emplace_back ("board", Patch {});
    auto& board = g.graphs.back().second;
    board.nodes.push_back (*g.root.find ("grain"));
    board.nodes.back().id = newId();
    board.wires.push_back (wire ("grain[0]/gain.out -> grain[1]/gain.in"));
    board.expose.outputs = { { "force", { "grain[1]", "force" } } };
    g.root.nodes.push_back (node ("plank"));
    g.root.nodes.back().type = "graph:board";
    g.root.nodes.back().extra["count"] = 3;
    g.root.nodes.back().overrides = { { "[2]/grain[1]/wave.phase", 5 }, { "grain/wave.phase", 4 }, { "[0]/grain/wave.phase", 3 } };
    g.controls[0].to.push_back ({ "plank[1]/grain/wave.angle", 0, 1 });
    auto shown = g;

    perform (g, ExpandNode { "board", "grain" });
    CHECK (toText (g.find ("board")->wires[0]) == "grain_0/gain.out -> grain_1/gain.in");
    CHECK (toText (g.find ("board")->expose.outputs[0].second) == "grain_1.force");
    CHECK (g.root.find ("plank")->overrides
           == Json { { "grain_0/wave.phase", 4 },
                     { "grain_1/wave.phase", 4 },
                     { "[0]/grain_0/wave.phase", 3 },
                     { "[0]/grain_1/wave.phase", 3 },
                     { "[2]/grain_1/wave.phase", 5 } });
    CHECK (g.controls[0].to[2].path == "plank[1]/grain_0/wave.angle");
    CHECK (g.controls[0].to[3].path == "plank[1]/grain_1/wave.angle");

    shown.graphs.back().second.expose.outputs[0].second.node = "grain";
    CHECK (refusal (shown, ExpandNode { "board", "grain" }) == "edit/cannot_expand");
    g = woodGraph();
    (void)apply (g, AddWire { "", wire ("grain[2].force -> motor.force") }, Checks::none);
    CHECK (refusal (g, ExpandNode { "", "grain" }) == "edit/cannot_expand");
}

TEST_CASE ("overrides for instances inside survive when the node is expanded")
{
    auto g = woodGraph();
    perform (g, CollapseNodes { "", { "grain", "hand" }, "tool", "tool" });
    CHECK (toText (g.find ("tool")->wires[0]) == "hand.position -> grain[1]/wave.position");
    CHECK (g.controls[0].to[0].path == "tool/grain/wave.amplitude");
    perform (g, SetOverride { "", "tool", "grain[0]/wave.phase", 7 });
    perform (g, SetOverride { "", "tool", "grain/wave.angle", 8 });
    perform (g, ExpandNode { "", "tool" });
    CHECK (g.root.find ("grain")->overrides
           == Json { { "wave.phase", 1 }, { "wave.angle", 8 }, { "[0]/wave.phase", 7 } });   // 8 was set from outside, for all instances
    CHECK (g.controls[0].to[0].path == "grain/wave.amplitude");
}

TEST_CASE ("a collapse or expansion that is impossible is refused and changes nothing")
{
    auto g = woodGraph();
    CHECK (refusal (g, CollapseNodes { "", {}, "a", "b" }) == "edit/bad_value");
    CHECK (refusal (g, CollapseNodes { "", { "none" }, "a", "b" }) == "edit/unknown_node");
    CHECK (refusal (g, CollapseNodes { "", { "drag" }, "hand", "b" }) == "edit/name_taken");
    CHECK (refusal (g, CollapseNodes { "", { "drag" }, "a", "grain" }) == "edit/name_taken");
    CHECK (refusal (g, CollapseNodes { "", { "drag" }, "A", "b" }) == "graph/bad_id");
    CHECK (refusal (g, ExpandNode { "", "drag" }) == "edit/cannot_expand");
    perform (g, SetNodeKey { "", "grain", "count", std::nullopt });
    perform (g, SetNodeKey { "", "grain", "overrides", std::nullopt });
    perform (g, RemoveWire { "", g.root.wires[1].id });
    (void)apply (g, AddWire { "", wire ("grain.nothing -> motor.force") }, Checks::none);
    CHECK (refusal (g, ExpandNode { "", "grain" }) == "edit/cannot_expand");
    g.root.wires.pop_back();
    perform (g, ExpandNode { "", "grain" });
}
