// SPDX-License-Identifier: MIT
#include "references.hpp"

#include <tactus/text/json_text.hpp>

#include <algorithm>

namespace tactus::graph
{
namespace
{
/// Visits everything in a graph that names nodes, and renames or drops the references to one node.
class References
{
public:
    References (Graph& g, std::string_view p, std::string_view n, const std::string_view* t)
        : graph (g), patch (p.empty() ? &g.root : g.find (p)), node (n), to (t)
    {
    }

    std::vector<Command> everywhere()
    {
        inPatch ("", graph.root);
        for (auto& [name, subgraph] : graph.graphs)
            inPatch (name, subgraph);
        for (auto& control : graph.controls)
            inControl (control);
        return std::move (back);
    }

private:
    enum class Found
    {
        nothing,
        renamed,
        drop
    };

    const Patch* subgraphOf (const Node* instance) const
    {
        constexpr std::string_view prefix = "graph:";
        return instance != nullptr && instance->type.starts_with (prefix) ? graph.find (std::string_view (instance->type).substr (prefix.size())) : nullptr;
    }

    /// Follows the nodes of a path, starting in a patch, up to the dot of the port if there is one.
    Found follow (std::string& path, const Patch* from) const
    {
        auto found = Found::nothing;
        std::size_t begin = path.find_first_not_of (" \t\r\n");
        while (from != nullptr && begin < path.size())
        {
            const auto end = std::min (path.find_first_of ("/.", begin), path.size());
            const auto name = std::string_view (path).substr (begin, std::min (path.find ('[', begin), end) - begin);
            const bool last = end == path.size() || path[end] == '.';
            const auto* next = last ? nullptr : subgraphOf (from->find (name));
            auto after = end;
            if (from == patch && name == node)
            {
                if (to == nullptr) return Found::drop;
                after += to->size() - name.size();
                path.replace (begin, name.size(), *to);
                found = Found::renamed;
            }
            if (last) break;
            from = next;
            begin = after + 1;
        }
        return found;
    }

    void inPatch (const std::string& name, Patch& p)
    {
        std::vector<Wire> kept;
        kept.reserve (p.wires.size());
        for (std::size_t i = 0; i < p.wires.size(); ++i)
        {
            auto& wire = p.wires[i];
            auto changed = wire;
            const auto a = follow (changed.from.node, &p), b = follow (changed.to.node, &p);
            if (a == Found::drop || b == Found::drop)
            {
                back.push_back (AddWire { name, std::move (wire), i });
                continue;
            }
            if (a == Found::renamed || b == Found::renamed) back.push_back (ChangeWire { name, wire.id, std::exchange (wire, std::move (changed)) });
            kept.push_back (std::move (wire));
        }
        p.wires = std::move (kept);

        auto expose = p.expose;
        bool touched = false;
        for (auto* list : { &expose.inputs, &expose.outputs, &expose.params })
            std::erase_if (*list, [&] (auto& shown) {
                const auto found = follow (shown.second.node, &p);
                touched = touched || found != Found::nothing;
                return found == Found::drop;
            });
        if (touched) back.push_back (ChangeExpose { name, std::exchange (p.expose, std::move (expose)) });

        for (auto& n : p.nodes)
            if (const auto* inside = subgraphOf (&n); inside != nullptr && ! n.overrides.empty()) inOverrides (name, n, inside);
    }

    /// Overrides are relative to their node: "[3]/wave.mu" begins inside its subgraph.
    void inOverrides (const std::string& in, Node& n, const Patch* inside)
    {
        auto changed = Json::object();
        bool touched = false;
        for (const auto& [key, value] : n.overrides.asObject())
        {
            const auto slash = key.starts_with ('[') ? key.find ('/') : std::string::npos;
            const auto begin = slash == std::string::npos ? 0 : slash + 1;
            auto path = key.substr (begin);
            const auto found = follow (path, inside);
            touched = touched || found != Found::nothing;
            if (found != Found::drop) append (changed, key.substr (0, begin) + path, value);
        }
        if (touched) back.push_back (SetNodeKey { in, n.name, "overrides", std::exchange (n.overrides, std::move (changed)) });
    }

    void inControl (Control& control)
    {
        auto changed = control;
        bool touched = false;
        std::erase_if (changed.to, [&] (Control::Target& target) {
            const auto found = follow (target.path, &graph.root);
            touched = touched || found != Found::nothing;
            return found == Found::drop;
        });
        if (touched) back.push_back (ChangeControl { control.id, std::exchange (control, std::move (changed)) });
    }

    Graph& graph;
    const Patch* patch;
    std::string_view node;
    const std::string_view* to;   ///< the new name; null: drop the references
    std::vector<Command> back;
};
}   // namespace

std::vector<Command> renameReferences (Graph& graph, std::string_view patch, std::string_view node, std::string_view to)
{
    return References (graph, patch, node, &to).everywhere();
}

std::vector<Command> dropReferences (Graph& graph, std::string_view patch, std::string_view node)
{
    return References (graph, patch, node, nullptr).everywhere();
}

}   // namespace tactus::graph
