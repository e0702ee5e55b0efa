// SPDX-License-Identifier: MIT
#include "endpoints.hpp"

#include "endpoint_text.hpp"

#include <tactus/text/json_text.hpp>

#include <algorithm>

namespace tactus::graph
{
namespace
{
using Visit = std::function<bool (Endpoint&, const Waypoint&)>;

class Walk
{
public:
    Walk (Graph& g, const Visit& v) : graph (g), visit (v) {}

    void everywhere()
    {
        inPatch (graph.root);
        for (auto& [name, patch] : graph.graphs)
            inPatch (patch);
        for (auto& control : graph.controls)
            for (auto& target : control.to)
                if (auto e = parseEndpoint (target.path))
                    if (follow (*e, &graph.root, Side::param)) target.path = toText (*e);
    }

private:
    const Patch* subgraphOf (const Node* n) const
    {
        return n != nullptr && n->type.starts_with ("graph:") ? graph.find (std::string_view (n->type).substr (6)) : nullptr;
    }

    /// Returns true if `visit` rewrote the endpoint.
    bool follow (Endpoint& e, const Patch* from, Side side, std::size_t begin = 0)
    {
        const auto as_written = e;
        while (from != nullptr && begin < e.node.size())
        {
            const auto end = std::min (e.node.find ('/', begin), e.node.size());
            const auto name = e.node.substr (begin, std::min (e.node.find ('[', begin), end) - begin);
            goes_on = goes_on && visit (e, { from, side, name, begin, end });
            if (! (e == as_written)) return true;
            from = subgraphOf (from->find (name));
            begin = end + 1;
        }
        return false;
    }

    void inPatch (Patch& p)
    {
        for (auto& w : p.wires)
        {
            follow (w.from, &p, Side::start);
            follow (w.to, &p, Side::end);
        }
        for (auto& [name, e] : p.expose.inputs)
            follow (e, &p, Side::end);
        for (auto& [name, e] : p.expose.outputs)
            follow (e, &p, Side::start);
        for (auto& [name, e] : p.expose.params)
            follow (e, &p, Side::param);
        for (auto& n : p.nodes)
            if (const auto* inside = subgraphOf (&n); inside != nullptr && ! n.overrides.empty()) inOverrides (n, inside);
    }

    void inOverrides (Node& n, const Patch* inside)
    {
        auto changed = Json::object();
        bool touched = false;
        for (const auto& [key, value] : n.overrides.items())
        {
            auto e = parseOverride (key);
            const auto begin = e && e->node.starts_with ('[') ? e->node.find ('/') + 1 : 0;
            const bool rewritten = e && follow (*e, inside, Side::param, begin);
            touched = touched || rewritten;
            append (changed, rewritten ? toText (*e) : key, value);
        }
        if (touched) n.overrides = std::move (changed);
    }

    Graph& graph;
    const Visit& visit;
    bool goes_on = true;
};
}   // namespace

void forEachEndpoint (Graph& graph, const Visit& visit) { Walk (graph, visit).everywhere(); }

std::string firstNameOf (const std::string& path) { return path.substr (0, path.find_first_of ("[/")); }

}   // namespace tactus::graph
