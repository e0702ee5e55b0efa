// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/edit.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <catch2/catch.hpp>

#include <string>
#include <utility>

/// A graph to edit, and checks of single edits.
namespace tactus::test
{

/// A stylus on wood: a graph with a subgraph that is used twice, overrides and a control.
inline graph::Graph woodGraph()
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
inline std::string fingerprint (const graph::Graph& g)
{
    auto text = writeGraph (g);
    const auto ids = [&] (const graph::Patch& patch) {
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
inline void perform (graph::Graph& g, const graph::Command& command)
{
    const auto before = fingerprint (g);
    auto result = graph::apply (g, command);
    if (! result) FAIL (result.error().text);
    const auto after = fingerprint (g);
    CHECK (after != before);
    auto forward = graph::apply (g, *result, graph::Checks::none);
    CHECK (fingerprint (g) == before);
    (void)graph::apply (g, *forward, graph::Checks::none);
    CHECK (fingerprint (g) == after);
}

/// The id of the message of a refused command. Checks that the graph is unchanged.
inline std::string refusal (graph::Graph& g, const graph::Command& command)
{
    const auto before = fingerprint (g);
    const auto result = graph::apply (g, command);
    CHECK (fingerprint (g) == before);
    return result ? "" : result.error().id;
}

/// A gain with the given name.
inline graph::Node node (std::string name)
{
    graph::Node n;
    n.name = std::move (name);
    n.type = "signal.gain";
    return n;
}

inline graph::Wire wire (const char* text) { return *graph::parseWire (text); }

/// True if the file of the graph contains this text.
inline bool contains (const graph::Graph& g, const char* text) { return writeGraph (g).find (text) != std::string::npos; }

}   // namespace tactus::test
