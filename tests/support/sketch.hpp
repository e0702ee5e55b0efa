// SPDX-License-Identifier: MIT
#pragma once

#include <framework/engine.hpp>
#include <framework/graph/graph.hpp>
#include <framework/graph/text.hpp>
#include <framework/plan/compile.hpp>

#include <string>

namespace tactus::test
{

/// A graph drawn in code: Sketch {}.node ("a", "signal.gain").wire ("a.out -> b.in").
struct Sketch
{
    graph::Graph graph;

    Sketch& node (std::string name, std::string type, Json params = Json::object(), Json settings = Json::object())
    {
        return add (graph.root, std::move (name), std::move (type), std::move (params), std::move (settings));
    }

    Sketch& wire (const std::string& text) { return add (graph.root, text); }

    static graph::Node makeNode (std::string name, std::string type, Json params = Json::object(), Json settings = Json::object())
    {
        graph::Node n;
        n.name = std::move (name);
        n.type = std::move (type);
        n.params = std::move (params);
        n.settings = std::move (settings);
        return n;
    }

    Sketch& add (graph::Patch& patch, std::string name, std::string type, Json params = Json::object(), Json settings = Json::object())
    {
        patch.nodes.push_back (makeNode (std::move (name), std::move (type), std::move (params), std::move (settings)));
        if (patch.nodes.back().type.starts_with ("device.")) patch.nodes.back().role = "stylus";
        return *this;
    }

    Sketch& add (graph::Patch& patch, const std::string& text)
    {
        patch.wires.push_back (std::get<graph::Wire> (graph::parseWire (text)));
        return *this;
    }

    graph::Patch& subgraph (const std::string& name)
    {
        for (auto& [id, patch] : graph.graphs)
            if (id == name) return patch;
        return graph.graphs.emplace_back (name, graph::Patch {}).second;
    }

    Compiled compile (CompileOptions options = {}) const { return tactus::compile (graph, catalogue(), options); }
};

/// True if a message of this id is among them.
inline bool has (const Messages& messages, std::string_view id) { return std::ranges::count (messages, id, &Message::id) > 0; }

/// The messages as text, for INFO.
inline std::string text (const Messages& messages)
{
    std::string all;
    for (const auto& m : messages)
        all += m.id + " at " + m.where + ": " + m.text + "; " + m.remedy + "\n";
    return all;
}

}   // namespace tactus::test
