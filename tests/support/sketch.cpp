// SPDX-License-Identifier: MIT
#include "sketch.hpp"

#include <algorithm>

namespace tactus::test
{

Sketch& Sketch::node (std::string name, std::string type) { return add (graph.root, std::move (name), std::move (type)); }

Sketch& Sketch::node (std::string name, std::string type, Json params) { return add (graph.root, std::move (name), std::move (type), std::move (params)); }

Sketch& Sketch::node (std::string name, std::string type, Json params, Json settings)
{
    return add (graph.root, std::move (name), std::move (type), std::move (params), std::move (settings));
}

Sketch& Sketch::wire (const std::string& text) { return add (graph.root, text); }

graph::Node Sketch::makeNode (std::string name, std::string type) { return makeNode (std::move (name), std::move (type), Json::object(), Json::object()); }

graph::Node Sketch::makeNode (std::string name, std::string type, Json params)
{
    return makeNode (std::move (name), std::move (type), std::move (params), Json::object());
}

graph::Node Sketch::makeNode (std::string name, std::string type, Json params, Json settings)
{
    graph::Node n;
    n.name = std::move (name);
    n.type = std::move (type);
    n.params = std::move (params);
    n.settings = std::move (settings);
    return n;
}

Sketch& Sketch::add (graph::Patch& patch, std::string name, std::string type)
{
    return add (patch, std::move (name), std::move (type), Json::object(), Json::object());
}

Sketch& Sketch::add (graph::Patch& patch, std::string name, std::string type, Json params)
{
    return add (patch, std::move (name), std::move (type), std::move (params), Json::object());
}

Sketch& Sketch::add (graph::Patch& patch, std::string name, std::string type, Json params, Json settings)
{
    patch.nodes.push_back (makeNode (std::move (name), std::move (type), std::move (params), std::move (settings)));
    if (patch.nodes.back().type.starts_with ("device.")) patch.nodes.back().role = "stylus";
    return *this;
}

Sketch& Sketch::add (graph::Patch& patch, const std::string& wire)
{
    patch.wires.push_back (*graph::parseWire (wire));
    return *this;
}

graph::Patch& Sketch::subgraph (const std::string& name)
{
    for (auto& [id, patch] : graph.graphs)
        if (id == name) return patch;
    return graph.graphs.emplace_back (name, graph::Patch {}).second;
}

Compiled Sketch::compile (const CompileOptions& options) const { return tactus::compile (graph, catalogue(), options); }

bool has (const Messages& messages, std::string_view id) { return std::ranges::count (messages, id, &Message::id) > 0; }

std::string text (const Messages& messages)
{
    std::string all;
    for (const auto& m : messages)
        all += m.id + " at " + m.where + ": " + m.text + "; " + m.remedy + "\n";
    return all;
}

}   // namespace tactus::test
