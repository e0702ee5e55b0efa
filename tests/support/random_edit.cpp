// SPDX-License-Identifier: MIT
#include "random_edit.hpp"
#include "random_graph.hpp"

#include <tactus/node/catalogue.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::test
{

namespace
{
class Editor
{
public:
    Editor (std::mt19937& r, const graph::Graph& graph_, const std::string& prefix_, const std::string& role_)
        : random (r), g (graph_), prefix (prefix_), role (role_) {}

    graph::Command any()
    {
        for (;;)
            if (auto command = attempt()) return std::move (*command);
    }

private:
    std::mt19937& random;
    const graph::Graph& g;
    const std::string &prefix, &role;
    std::string in;   // the patch being edited

    int below (int n) { return std::uniform_int_distribution { 0, std::max (n, 1) - 1 }(random); }
    bool oneIn (int n) { return below (n) == 0; }
    bool isOurs (const std::string& name) const { return name.starts_with (prefix); }

    template <typename List>
    auto* oneOf (List& list)
    {
        return list.empty() ? nullptr : &list[static_cast<std::size_t> (below (static_cast<int> (list.size())))];
    }

    const graph::Patch& patch() const { return in.empty() ? g.root : *g.find (in); }
    std::string freshName() { return prefix + "x" + std::to_string (below (1000)); }

    /// The new node is never one of the edited subgraphs: a subgraph must never contain itself, and the nesting must end.
    graph::Node newNode()
    {
        auto n = randomNode (random, freshName(), {});
        if (! n.role.empty()) n.role = role;
        return n;
    }

    std::optional<graph::Command> attempt()
    {
        in.clear();
        if (! g.graphs.empty() && oneIn (4))
            if (const auto& name = oneOf (g.graphs)->first; isOurs (name)) in = name;

        const auto* node = oneOf (patch().nodes);
        if (node == nullptr || ! isOurs (node->name)) return oneIn (20) ? std::optional<graph::Command> (graph::AddNode { in, newNode() }) : std::nullopt;
        const auto* type = catalogue().find (node->type);

        if (node->type.starts_with ("graph:") && oneIn (3)) return setRate (*node);
        switch (below (12))
        {
        case 0:
            return patch().nodes.size() < 30 ? std::optional<graph::Command> (graph::AddNode { in, newNode() }) : std::nullopt;
        case 1:
            return graph::RemoveNode { in, node->name };
        case 2:
            return graph::RenameNode { in, node->name, freshName() };
        case 3:
        case 4:
            if (type) return setParam (*node, *type);
            return node->type.starts_with ("graph:") ? setOverride (*node) : std::nullopt;
        case 5:
            return type ? setSetting (*node, *type) : std::nullopt;
        case 6:
            return graph::SetNodeKey { in, node->name, "bypass", oneIn (2) ? std::optional<Json> (true) : std::nullopt };
        case 7:
            if (node->type.starts_with ("graph:"))
                return graph::SetNodeKey { in, node->name, "count", oneIn (4) ? std::nullopt : std::optional<Json> (1 + below (4)) };
            return graph::SetNodeKey { in, node->name, "type", Json (newNode().type) };
        case 8:
        case 9:
            return addWire (*node);
        default:
            return changeWire();
        }
    }

    /// The key that sets the node's rate; a random one if it has none.
    const char* rateKey (const graph::Node& node)
    {
        for (const char* key : { "every", "times" })
            if (node.extra.contains (key)) return key;
        return oneIn (2) ? "every" : "times";
    }

    graph::Command setRate (const graph::Node& node)
    {
        if (node.extra.contains ("every") && oneIn (3)) return graph::SetNodeKey { in, node.name, "hold", Json (oneIn (2) ? "linear" : "latch") };
        return graph::SetNodeKey { in, node.name, rateKey (node), oneIn (3) ? std::nullopt : std::optional<Json> (1 + below (4)) };
    }

    std::optional<graph::Command> setParam (const graph::Node& node, const NodeType& type)
    {
        const auto* sheet = oneOf (type.params);
        if (sheet == nullptr || sheet->list) return std::nullopt;
        const std::string id (sheet->id);
        if (const auto* choice = oneOf (sheet->choices)) return graph::SetParam { in, node.name, id, Json (*choice) };

        const auto number = [&] {
            const auto& usual = sheet->limits.usual;
            const double low = std::isfinite (usual.min) ? usual.min : -1.0, high = std::isfinite (usual.max) ? usual.max : low + 2.0;
            return sheet->limits.hard.clamp (std::uniform_real_distribution { low, high }(random));
        };
        if (sheet->width == 1) return graph::SetParam { in, node.name, id, Json (number()) };
        return graph::SetParam { in, node.name, id, Json::array ({ number(), number(), number() }) };
    }

    /// An override of an inner node, for all instances or for one.
    std::optional<graph::Command> setOverride (const graph::Node& node)
    {
        const auto* inner = oneOf (g.find (node.type.substr (6))->nodes);
        const auto* type = inner ? catalogue().find (inner->type) : nullptr;
        const auto set = type ? setParam (*inner, *type) : std::nullopt;
        if (! set) return std::nullopt;
        const auto& [in_patch, name, param, value, place] = std::get<graph::SetParam> (set->edit);
        const auto instance = oneIn (2) && node.extra.contains ("count") ? "[" + std::to_string (below (3)) + "]/" : "";
        return graph::SetOverride { in, node.name, instance + name + "." + param, value };
    }

    std::optional<graph::Command> setSetting (const graph::Node& node, const NodeType& type)
    {
        const auto* sheet = oneOf (type.settings);
        if (sheet == nullptr) return std::nullopt;
        const std::string id (sheet->id);
        if (id == "inputs" || id == "ticks") return graph::SetSetting { in, node.name, id, Json (1 + below (5)) };
        if (id != "modes") return std::nullopt;
        auto modes = Json::array();
        for (int i = below (3); i >= 0; --i)
            modes.push_back ({ { "frequency", 100.0 + 80.0 * i }, { "decay", 20.0 }, { "amplitude", 0.5 } });
        return graph::SetSetting { in, node.name, id, modes };
    }

    /// A wire from anywhere in the patch to one of the edited nodes.
    std::optional<graph::Command> addWire (const graph::Node& to)
    {
        if (patch().wires.size() > 80) return std::nullopt;
        auto wire = randomWire (random, *oneOf (patch().nodes), to, g);
        if (! wire) return std::nullopt;
        return graph::AddWire { in, std::move (*wire) };
    }

    std::optional<graph::Command> changeWire()
    {
        const auto* wire = oneOf (patch().wires);
        if (wire == nullptr || ! isOurs (wire->to.node)) return std::nullopt;
        if (oneIn (3)) return graph::RemoveWire { in, wire->id };
        auto to = *wire;
        switch (below (3))
        {
        case 0:
            to.delay = below (6);
            break;
        case 1:
            if (! to.gain.is_string()) to.gain = 0.25 * below (9) - 1.0;
            break;
        default:
            to.enabled = oneIn (2);
        }
        return graph::ChangeWire { in, wire->id, std::move (to) };
    }
};
}   // namespace

graph::Graph prefixed (graph::Graph g, const std::string& prefix, const std::string& role)
{
    const auto path = [&] (std::string names) {
        for (auto at = names.find ('/'); at != std::string::npos; at = names.find ('/', at + 1))
            names.insert (at + 1, prefix);
        return names.starts_with ('[') ? names : prefix + names;
    };
    const auto rename = [&] (graph::Patch& patch) {
        for (auto& n : patch.nodes)
        {
            n.name = prefix + n.name;
            if (n.type.starts_with ("graph:")) n.type.insert (6, prefix);
            if (! n.role.empty()) n.role = role;
            n.roles = {};
            auto overrides = Json::object();
            for (const auto& [key, value] : n.overrides.items())
                overrides[path (key)] = value;
            n.overrides = std::move (overrides);
        }
        for (auto& w : patch.wires)
            for (auto* end : { &w.from, &w.to })
                end->node = path (end->node);
        for (auto* list : { &patch.expose.inputs, &patch.expose.outputs, &patch.expose.params })
            for (auto& [name, end] : *list)
                end.node = path (end.node);
    };
    rename (g.root);
    for (auto& [name, patch] : g.graphs)
    {
        name = prefix + name;
        rename (patch);
    }
    return g;
}

graph::Graph sideBySide (graph::Graph a, graph::Graph b)
{
    std::ranges::move (b.root.nodes, std::back_inserter (a.root.nodes));
    std::ranges::move (b.root.wires, std::back_inserter (a.root.wires));
    std::ranges::move (b.graphs, std::back_inserter (a.graphs));
    return a;
}

graph::Command randomEdit (std::mt19937& random, const graph::Graph& g, const std::string& prefix, const std::string& role)
{
    return Editor { random, g, prefix, role }.any();
}

graph::Command randomRegrouping (std::mt19937& random, const graph::Graph& g)
{
    const auto below = [&] (std::size_t n) { return std::uniform_int_distribution<std::size_t> { 0, n - 1 }(random); };
    const auto fresh = [&] (const char* prefix) { return prefix + std::to_string (random() % 100000); };
    std::string in;
    const graph::Patch* patch = &g.root;
    if (! g.graphs.empty() && below (2) == 0)
    {
        const auto& [name, inside] = g.graphs[below (g.graphs.size())];
        in = name;
        patch = &inside;
    }
    if (patch->nodes.empty()) return graph::SetHeader { .about = fresh ("about ") };

    const auto& node = patch->nodes[below (patch->nodes.size())];
    switch (below (6))
    {
    case 0:
        return graph::RenameNode { in, node.name, fresh ("r") };
    case 1:
        if (in.empty()) return graph::SetHeader { .name = fresh ("name ") };
        return graph::RenameSubgraph { in, fresh ("s") };
    case 2:
    case 3:
        for (const auto& n : patch->nodes)
            if (n.type.starts_with ("graph:") && below (2) == 0) return graph::ExpandNode { in, n.name };
        return graph::RenameNode { in, node.name, fresh ("r") };
    default:
        graph::CollapseNodes collapse { in, {}, fresh ("c"), fresh ("g") };
        for (const auto& n : patch->nodes)
            if (below (4) == 0 || &n == &node) collapse.nodes.push_back (n.name);
        return collapse;
    }
}

}   // namespace tactus::test
