// SPDX-License-Identifier: MIT
#include <framework/file/graph_file.hpp>
#include <framework/graph/edit.hpp>
#include <framework/graph/history.hpp>
#include <framework/graph/param_edit.hpp>
#include <framework/graph/text.hpp>

#include "wild_graph.hpp"

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <random>

using namespace tactus;
using namespace tactus::graph;
using Catch::Matchers::Contains;

namespace
{
Graph woodGraph()
{
    auto loaded = readGraph (R"({ "format": "tactus-graph", "version": 1,
  "nodes": {
    "hand": { "type": "device.position", "role": "stylus" },
    "drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.4, "d_max": "0.4 mm" } },
    "grain": { "type": "graph:grain", "count": 2, "overrides": { "wave.phase": 1, "[1]/wave.angle": 2 } },
    "motor": { "type": "device.force", "role": "stylus" }
  },
  "wires": [ "hand.position -> drag.position", "hand.position -> grain[1]/wave.position", "drag.force -> motor.force", "grain.force -> motor.force" ],
  "controls": { "roughness": { "value": 0.5, "to": { "grain/wave.amplitude": [0, 1], "drag.mu": [0, 1] } } },
  "graphs": { "grain": { "nodes": { "wave": { "type": "texture.grating" }, "gain": { "type": "signal.gain" } }, "wires": [ "wave.value -> gain.in" ],
      "expose": { "inputs": { "position": "wave.position" }, "outputs": { "force": "wave.force" } } } } })");
    REQUIRE (loaded.messages.empty());
    return std::move (loaded.graph);
}

/// Everything that undo must restore: the bytes of the file, and the ids, which the file does not contain.
std::string fingerprint (const Graph& g)
{
    auto text = writeGraph (g);
    const auto ids = [&] (const Patch& patch) {
        for (const auto& n : patch.nodes)
            text.append (std::to_string (n.id)).append (1, ' ');
        for (const auto& w : patch.wires)
            text.append (std::to_string (w.id)).append (1, ' ');
        text += '\n';
    };
    ids (g.root);
    for (const auto& [name, patch] : g.graphs)
        ids (patch);
    return text;
}

/// Carries out a command, undoes it and redoes it.
void perform (Graph& g, const Command& command)
{
    const auto before = fingerprint (g);
    auto result = apply (g, command);
    if (! result) FAIL (result.error().text);
    const auto after = fingerprint (g);
    CHECK (after != before);
    auto forward = apply (g, *result, Checks::none);
    CHECK (fingerprint (g) == before);
    (void)apply (g, *forward, Checks::none);
    CHECK (fingerprint (g) == after);
}

/// The id of the message of a refused command. Checks that the graph is unchanged.
std::string refusal (Graph& g, const Command& command)
{
    const auto before = fingerprint (g);
    const auto result = apply (g, command);
    CHECK (fingerprint (g) == before);
    return result ? "" : result.error().id;
}

graph::Node node (std::string name)
{
    graph::Node n;
    n.name = std::move (name);
    n.type = "signal.gain";
    return n;
}

Wire wire (const char* text) { return *parseWire (text); }

bool contains (const Graph& g, const char* text) { return writeGraph (g).find (text) != std::string::npos; }

//==============================================================================
/// Generates edits that a person or a program might try. A third of them are invalid.
class Meddler
{
public:
    explicit Meddler (std::uint64_t seed) : engine (seed) {}

    /// Long because it is one table: a case for each kind of edit.
    Command any (const Graph& g, int depth = 2)
    {
        const auto patch = anyPatch (g);
        const auto* p = patch.empty() ? &g.root : g.find (patch);
        switch (upTo (depth > 0 ? 20 : 19))
        {
        case 0:
            return AddNode { patch, anyNode (g), place() };
        case 1:
            return RemoveNode { patch, nodeIn (p) };
        case 2:
            return RenameNode { patch, nodeIn (p), name() };
        case 3:
            return SetParam { patch, nodeIn (p), oneOf ({ "mu", "gain", "position", "No" }), maybe (0.5) };
        case 4:
            return SetSetting { patch, nodeIn (p), oneOf ({ "curve", "table" }), maybe (Json::array ({ 1, 2 })) };
        case 5:
            return SetNodeKey { patch, nodeIn (p), oneOf ({ "role", "type" }), maybe (oneOf ({ "stylus", "graph:sub1", "Bad" })) };
        case 6:
            return SetNodeKey { patch, nodeIn (p), oneOf ({ "count", "ui", "note", "bypass" }),
                                maybe (oneIn (2) ? Json (2) : (oneIn (2) ? Json (true) : Json::object())) };
        case 7:
            if (oneIn (2)) return SetOverride { patch, nodeIn (p), oneOf ({ "n1.mu", "[1]/n1.mu", "[*]/n2[0]/n1.x", "bad" }), maybe (1), place() };
            return SetNodeKey { patch, nodeIn (p), "overrides", maybe (Json { { "n1.mu", 1 }, { "[1]/n1.mu", 2 }, { "n2/n1.x", 3 } }) };
        case 8:
            return AddWire { patch, anyWire (p), place() };
        case 9:
            return RemoveWire { patch, wireIn (p) };
        case 10:
            return ChangeWire { patch, wireIn (p), anyWire (p) };
        case 11:
            return AddControl { anyControl (g), place() };
        case 12:
            return RemoveControl { oneOf ({ "control1", "control2" }) };
        case 13:
            return ChangeControl { oneOf ({ "control1", "control2" }), anyControl (g) };
        case 14:
        {
            if (oneIn (2)) return RemoveSubgraph { oneOf ({ "sub1", "sub2", "new" }) };
            Patch fresh;
            fresh.nodes.push_back (anyNode (g));
            return AddSubgraph { oneOf ({ "sub1", "new", "No" }), fresh, place() };
        }
        case 15:
        {
            Expose expose;
            if (oneIn (2)) expose.inputs.emplace_back (oneOf ({ "in", "No" }), Endpoint { nodeIn (p), "x", -1, -1 });
            return ChangeExpose { patch, expose };
        }
        case 16:
        {
            if (oneIn (2)) return SetDevice { oneOf ({ "stylus", "thumb" }), maybe (Json { { "driver", "sim" } }), place() };
            SetHeader header { patch };
            if (oneIn (2)) header.name = "Name";
            if (oneIn (2)) header.rate_hz = oneIn (4) ? -1.0 : 1000.0;
            if (oneIn (2)) header.ui = maybe (Json { { "zoom", 2 } }).value_or (Json());
            return header;
        }
        case 17:
            return RenameSubgraph { oneOf ({ "sub1", "sub2", "new" }), oneOf ({ "sub1", "fresh", "No" }) };
        case 18:
        {
            CollapseNodes collapse { patch, {}, oneOf ({ "group", "n1", "No" }), oneOf ({ "new", "newer", "sub1" }) };
            for (int i = 1 + upTo (2); i > 0; --i)
                if (const auto n = nodeIn (p); std::ranges::count (collapse.nodes, n) == 0) collapse.nodes.push_back (n);
            return collapse;
        }
        case 19:
            return ExpandNode { patch, nodeIn (p) };
        default:
        {
            Batch batch { "several", {} };
            for (int i = upTo (3); i > 0; --i)
                batch.commands.push_back (any (g, depth - 1));
            return batch;
        }
        }
    }

private:
    int upTo (int n) { return std::uniform_int_distribution<int> (0, n) (engine); }
    bool oneIn (int n) { return upTo (n - 1) == 0; }
    std::string oneOf (std::initializer_list<const char*> list) { return *(list.begin() + upTo (static_cast<int> (list.size()) - 1)); }
    std::optional<Json> maybe (Json value) { return oneIn (3) ? std::nullopt : std::optional (std::move (value)); }
    Place place() { return oneIn (2) ? std::nullopt : Place (static_cast<std::size_t> (upTo (4))); }
    std::string name() { return oneOf ({ "n1", "n2", "n3", "n7", "ghost", "fresh", "Bad Name" }); }

    std::string anyPatch (const Graph& g)
    {
        if (g.graphs.empty() || oneIn (2)) return oneIn (10) ? "nowhere" : "";
        return g.graphs[static_cast<std::size_t> (upTo (static_cast<int> (g.graphs.size()) - 1))].first;
    }

    std::string nodeIn (const Patch* p)
    {
        if (p == nullptr || p->nodes.empty() || oneIn (5)) return name();
        return p->nodes[static_cast<std::size_t> (upTo (static_cast<int> (p->nodes.size()) - 1))].name;
    }

    Id wireIn (const Patch* p)
    {
        if (p == nullptr || p->wires.empty() || oneIn (5)) return 1;
        return p->wires[static_cast<std::size_t> (upTo (static_cast<int> (p->wires.size()) - 1))].id;
    }

    graph::Node anyNode (const Graph& g)
    {
        if (! g.root.nodes.empty() && oneIn (5)) return g.root.nodes[0];   // its id is already taken
        auto n = node (name());
        n.type = oneOf ({ "signal.gain", "graph:sub1" });
        if (oneIn (3)) n.params["gain"] = 2;
        return n;
    }

    Wire anyWire (const Patch* p)
    {
        Wire w;
        w.from = { nodeIn (p) + (oneIn (4) ? "/n1" : ""), oneOf ({ "out", "x", "Bad" }), -1, -1 };
        w.to = { nodeIn (p) + (oneIn (4) ? "[2]" : ""), "in", oneIn (3) ? 1 : -1, oneIn (3) ? 2 : -1 };
        if (oneIn (4)) w.gain = oneOf ({ "2 N", "many" });
        return w;
    }

    Control anyControl (const Graph& g)
    {
        Control c;
        c.id = oneOf ({ "control1", "control2", "control3", "No" });
        for (int i = upTo (2); i > 0; --i)
            c.to.push_back ({ nodeIn (&g.root) + (oneIn (3) ? "/n1" : "") + ".mu", 0, 1 });
        return c;
    }

    std::mt19937_64 engine;
};
}   // namespace

TEST_CASE ("removing a node removes everything that refers to it, and undo restores it all")
{
    auto g = woodGraph();
    perform (g, RemoveNode { "", "drag" });
    CHECK (g.root.wires.size() == 2);
    CHECK (g.controls[0].to.size() == 1);

    perform (g, RemoveNode { "grain", "wave" });
    CHECK_FALSE (contains (g, "wave"));
    CHECK (g.find ("grain")->expose.inputs.empty());
    CHECK (g.find ("grain")->wires.empty());
    CHECK (g.root.find ("grain")->overrides.empty());
    CHECK (g.controls[0].to.empty());
    CHECK (g.root.wires.size() == 1);
}

TEST_CASE ("references to a node follow its new name, even through instances of its subgraph")
{
    auto g = woodGraph();
    perform (g, RenameNode { "grain", "wave", "ripple" });
    CHECK_FALSE (contains (g, "wave"));
    CHECK (toText (g.root.wires[1]) == "hand.position -> grain[1]/ripple.position");
    CHECK (g.controls[0].to[0].path == "grain/ripple.amplitude");
    CHECK (g.root.find ("grain")->overrides.contains ("[1]/ripple.angle"));
    CHECK (g.find ("grain")->expose.outputs[0].second.node == "ripple");

    perform (g, RenameNode { "", "grain", "texture" });
    CHECK (toText (g.root.wires[1]) == "hand.position -> texture[1]/ripple.position");
    CHECK (g.controls[0].to[0].path == "texture/ripple.amplitude");
    CHECK (g.root.find ("texture")->type == "graph:grain");
}

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
    CHECK (toText (g.find ("grain")->expose.inputs[0].second) == "inner/wave.position");
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

TEST_CASE ("a turned parameter is stored under the name that was used to turn it")
{
    auto g = woodGraph();
    g.graphs[0].second.expose.params = { { "angle", { "wave", "angle" } } };
    const auto keep = [&] (const std::string& name, std::optional<Json> value) {
        auto command = paramEdit (g, name, std::move (value));
        if (! command) return command.error().id;
        perform (g, *command);
        return std::string();
    };
    CHECK (keep ("drag.mu", 0.5) == "");
    CHECK (g.root.find ("drag")->params["mu"] == 0.5);
    CHECK (keep ("grain.angle", 0.6) == "");
    CHECK (keep ("grain[*].angle", 0.7) == "");
    CHECK (g.root.find ("grain")->params == Json { { "angle", 0.7 } });
    CHECK (keep ("grain[0].angle", 0.1) == "");
    CHECK (keep ("grain/wave.phase", 0.2) == "");
    CHECK (keep ("grain[1]/wave.angle", 0.3) == "");
    CHECK (keep ("grain[*]/gain.gain", 0.4) == "");
    CHECK (g.root.find ("grain")->overrides == Json { { "wave.phase", 0.2 }, { "[1]/wave.angle", 0.3 }, { "[0]/wave.angle", 0.1 }, { "gain.gain", 0.4 } });
    CHECK (keep ("grain[0]/wave.angle", std::nullopt) == "");
    CHECK_FALSE (g.root.find ("grain")->overrides.contains ("[0]/wave.angle"));
    CHECK (keep ("none.mu", 1) == "edit/unknown_node");
    CHECK (keep ("mu", 1) == "param/name");
    CHECK (keep ("grain[0].mu", 1) == "param/unknown");
    CHECK (keep ("drag.mu.x", 1) == "param/shape");
    CHECK (refusal (g, SetOverride { "", "grain", "no path", 1 }) == "graph/bad_path");
    CHECK (refusal (g, SetOverride { "", "none", "wave.mu", 1 }) == "edit/unknown_node");
}

TEST_CASE ("renaming a subgraph changes the type of its nodes")
{
    auto g = woodGraph();
    perform (g, RenameSubgraph { "grain", "fibre" });
    CHECK (g.root.find ("grain")->type == "graph:fibre");
    CHECK (refusal (g, RenameSubgraph { "fibre", "Fibre" }) == "graph/bad_id");
    CHECK (refusal (g, RenameSubgraph { "grain", "x" }) == "edit/unknown_patch");
    CHECK (refusal (g, RenameSubgraph { "fibre", "fibre" }) == "edit/name_taken");
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

TEST_CASE ("an edit preserves the order of everything else")
{
    auto g = woodGraph();
    perform (g, AddNode { "", node ("fresh"), 1 });
    CHECK (g.root.nodes[1].name == "fresh");
    perform (g, AddWire { "", wire ("fresh.out -> (+) drag.mu"), 0 });
    CHECK (toText (g.root.wires[0]) == "fresh.out -> (+) drag.mu");
    perform (g, ChangeWire { "", g.root.wires[0].id, wire ("fresh.out -> [1] -> drag.mu") });
    perform (g, RemoveWire { "", g.root.wires[0].id });
    perform (g, SetParam { "", "drag", "mu", std::nullopt });
    CHECK_FALSE (g.root.find ("drag")->params.contains ("mu"));
    perform (g, SetParam { "", "drag", "mu", 0.6 });
    perform (g, SetParam { "grain", "wave", "amplitude", "60 mN" });
    perform (g, SetSetting { "", "drag", "adhesion_curve", Json::array() });
    perform (g, SetNodeKey { "", "drag", "bypass", true });
    perform (g, SetNodeKey { "", "hand", "role", "thumb" });
    perform (g, SetNodeKey { "", "grain", "roles", Json { { "tip", "thumb" } } });
    perform (g, SetNodeKey { "", "grain", "count", std::nullopt });
    perform (g, SetNodeKey { "", "grain", "overrides", std::nullopt });
    perform (g, SetNodeKey { "", "grain", "ui", Json { { "at", Json::array ({ 1, 2 }) } } });
    perform (g, ChangeControl { "roughness", Control { "feel", "Feel", 1.0, {}, Json::object() } });
    perform (g, RemoveControl { "feel" });
    perform (g, AddControl { Control { "feel", "Feel", 1.0, {}, Json::object() } });
    perform (g, AddSubgraph { "other", Patch {}, 0 });
    perform (g, RemoveSubgraph { "other" });
    perform (g, ChangeExpose { "grain", {} });
    perform (g, SetDevice { "stylus", Json { { "driver", "sim" } } });
    perform (g, SetDevice { "stylus", std::nullopt });
    perform (g, SetHeader { "", "Wood", "About wood", std::vector<std::string> { "wood" }, 1000.0, Json { { "zoom", 2 } } });
    perform (g, SetHeader { .patch = "grain", .ui = Json { { "zoom", 2 } } });
}

TEST_CASE ("an invalid edit is refused with a reason and changes nothing")
{
    auto g = woodGraph();
    const auto first = g.root.wires[0].id;
    CHECK (refusal (g, AddNode { "none", node ("a") }) == "edit/unknown_patch");
    CHECK (refusal (g, AddNode { "", node ("drag") }) == "edit/name_taken");
    CHECK (refusal (g, AddNode { "", node ("Drag") }) == "graph/bad_id");
    CHECK (refusal (g, AddNode { "", graph::Node {} }) == "graph/bad_id");
    auto copy = g.root.nodes[0];
    copy.name = "copy";
    CHECK (refusal (g, AddNode { "grain", copy }) == "edit/id_taken");
    CHECK (refusal (g, RemoveNode { "", "wave" }) == "edit/unknown_node");
    CHECK (refusal (g, RenameNode { "", "drag", "hand" }) == "edit/name_taken");
    CHECK (refusal (g, RenameNode { "", "drag", "2d" }) == "graph/bad_id");
    CHECK (refusal (g, SetParam { "", "drag", "d max", 1 }) == "graph/bad_id");
    CHECK (refusal (g, SetParam { "", "drag", "mu", std::numeric_limits<double>::quiet_NaN() }) == "edit/bad_value");
    CHECK (refusal (g, SetNodeKey { "", "drag", "role", "Left Hand" }) == "graph/bad_id");
    CHECK (refusal (g, SetNodeKey { "", "drag", "bypass", 1 }) == "file/wrong_kind");
    CHECK (refusal (g, SetNodeKey { "", "drag", "count", 0 }) == "file/bad_value");
    CHECK (refusal (g, SetNodeKey { "", "drag", "params", Json::object() }) == "edit/bad_value");
    CHECK (refusal (g, SetNodeKey { "", "drag", "type", std::nullopt }) == "edit/bad_value");
    CHECK (refusal (g, AddWire { "", wire ("none.out -> drag.mu") }) == "edit/unknown_node");
    CHECK (refusal (g, AddWire { "", g.root.wires[0] }) == "edit/id_taken");
    CHECK (refusal (g, RemoveWire { "grain", first }) == "edit/unknown_wire");
    auto bad = wire ("hand.position -> drag.position");
    bad.gain = "much";
    CHECK (refusal (g, ChangeWire { "", first, bad }) == "unit/syntax");
    bad.gain = nullptr;
    bad.to.port = "a.b";
    CHECK (refusal (g, ChangeWire { "", first, bad }) == "wire/syntax");
    CHECK (refusal (g, RemoveControl { "none" }) == "edit/unknown_control");
    CHECK (refusal (g, AddControl { g.controls[0] }) == "edit/name_taken");
    CHECK (refusal (g, ChangeControl { "roughness", Control { "roughness", "", 2.0, {}, Json::object() } }) == "file/bad_value");
    CHECK (refusal (g, ChangeControl { "roughness", Control { "roughness", "", 0.5, { { "none.mu", 0, 1 } }, Json::object() } }) == "edit/unknown_node");
    CHECK (refusal (g, RemoveSubgraph { "grain" }) == "edit/in_use");
    CHECK (refusal (g, RemoveSubgraph { "none" }) == "edit/unknown_patch");
    CHECK (refusal (g, SetDevice { "none", std::nullopt }) == "edit/unknown_device");
    CHECK (refusal (g, SetHeader { .rate_hz = 0.0 }) == "file/bad_value");
    CHECK (refusal (g, SetHeader { .patch = "grain", .name = "x" }) == "edit/bad_value");
    CHECK (refusal (g, Batch { "two", { RemoveNode { "", "drag" }, RemoveNode { "", "drag" } } }) == "edit/unknown_node");
}

TEST_CASE ("a node can get a name that dangling wires refer to, and undo makes them dangle again")
{
    auto g = woodGraph();
    (void)apply (g, AddWire { "", wire ("ghost.out -> motor.force") }, Checks::none);
    perform (g, RenameNode { "", "drag", "ghost" });
    auto other = woodGraph();
    (void)apply (other, AddWire { "", wire ("ghost.out -> motor.force") }, Checks::none);
    perform (other, AddNode { "", node ("ghost") });

    g = woodGraph();
    g.controls[0].to.push_back ({ "ghost.mu", 0, 1 });
    CHECK (refusal (g, RenameNode { "", "drag", "ghost" }) == "edit/name_taken");
}

TEST_CASE ("history names its steps, and turning a knob is one step")
{
    History history (woodGraph());
    const auto before = fingerprint (history.graph());
    REQUIRE (history.perform (RenameNode { "", "drag", "stick" }));
    REQUIRE (history.perform (SetParam { "", "stick", "mu", 0.1 }));
    for (int i = 2; i < 1000; ++i)
        REQUIRE (history.perform (SetParam { "", "stick", "mu", 0.001 * i }, Step::joined));
    REQUIRE (history.perform (Batch { "tidy up", { RemoveNode { "", "stick" } } }));
    CHECK_FALSE (history.perform (RemoveNode { "", "stick" }));
    CHECK (history.names() == std::vector<std::string> { "rename 'drag' to 'stick'", "set 'stick.mu'", "tidy up" });
    CHECK (history.undo());
    CHECK (history.undo());
    CHECK (history.graph().root.find ("stick")->params["mu"] == 0.4);
    CHECK (history.position() == 1);
    CHECK (history.redo());
    CHECK (history.graph().root.find ("stick")->params["mu"] == 0.999);
    CHECK (history.undo());
    CHECK (history.undo());
    CHECK_FALSE (history.undo());
    CHECK (fingerprint (history.graph()) == before);

    REQUIRE (history.perform (RemoveNode { "", "drag" }));
    CHECK_FALSE (history.redo());
    CHECK (history.names().size() == 1);
}

TEST_CASE ("every edit can be undone and redone, with the same bytes and ids")
{
    rc::prop ("random edits of random graphs", [] {
        const auto seed = *rc::gen::arbitrary<std::uint64_t>();
        auto start = test::wildGraph (seed);
        if (! start.root.nodes.empty() && seed % 3 == 0) start.root.nodes[0].name = "ghost";   // its wires now refer to a node that does not exist

        History history (std::move (start));
        Meddler meddler (seed);
        std::vector<std::string> states { fingerprint (history.graph()) };
        for (int i = 0; i < 30; ++i)
        {
            const auto before = fingerprint (history.graph());
            if (history.perform (meddler.any (history.graph())))
                states.push_back (fingerprint (history.graph()));
            else
                RC_ASSERT (fingerprint (history.graph()) == before);
        }
        RC_ASSERT (! hasErrors (readGraph (writeGraph (history.graph())).messages));

        RC_ASSERT (history.position() + 1 == states.size());
        for (auto i = states.size() - 1; i > 0; --i)
        {
            RC_ASSERT (history.undo());
            RC_ASSERT (fingerprint (history.graph()) == states[i - 1]);
        }
        for (std::size_t i = 1; i < states.size(); ++i)
        {
            RC_ASSERT (history.redo());
            RC_ASSERT (fingerprint (history.graph()) == states[i]);
        }
    });
}
