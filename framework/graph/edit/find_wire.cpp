// SPDX-License-Identifier: MIT
#include "find_wire.hpp"

#include "refusals.hpp"
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/inside.hpp>
#include <tactus/graph/instances.hpp>

#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <vector>

namespace tactus::graph
{

namespace
{
constexpr int deepest = 32;   // a broken graph may contain itself

/// The port itself, if a subgraph exposes it under the name of the endpoint, and no "[*]".
Endpoint innermost (const Graph& g, const Patch& p, Endpoint e, std::vector<std::pair<std::string, Endpoint>> Expose::*list)
{
    for (auto all = e.node.find ("[*]"); all != std::string::npos; all = e.node.find ("[*]"))
        e.node.erase (all, 3);

    Inside at { &g, &p };
    std::string_view rest = e.node;
    for (int depth = 0; at && depth < deepest; ++depth)
    {
        const Node* node = nullptr;
        if (! rest.empty())
        {
            const auto step = firstStep (rest);
            node = at.patch->find (step.name);
            rest = step.rest;
        }
        if (node == nullptr) return e;
        at = insideOf (*at.owner, *node);
        if (! at || ! rest.empty()) continue;

        const auto& exposed = at.patch->expose.*list;
        const auto found = std::ranges::find (exposed, e.port, &std::pair<std::string, Endpoint>::first);
        if (found == exposed.end()) return e;
        const auto& inner = found->second;
        e = { e.node + '/' + inner.node, inner.port, e.index >= 0 ? e.index : inner.index, e.component >= 0 ? e.component : inner.component };
        for (auto all = e.node.find ("[*]"); all != std::string::npos; all = e.node.find ("[*]"))
            e.node.erase (all, 3);
        return innermost (g, p, std::move (e), list);
    }
    return e;
}

Wire innermost (const Graph& g, const Patch& p, const Wire& w)
{
    Wire same;
    same.from = innermost (g, p, w.from, &Expose::outputs);
    same.to = innermost (g, p, w.to, &Expose::inputs);
    if (same.to == w.to) same.to = innermost (g, p, w.to, &Expose::params);
    same.delay = w.delay;
    same.add = w.add;
    return same;
}
}   // namespace

Result<Id> findWire (const Graph& g, const std::string& patch, const std::string& text)
{
    const auto* p = patch.empty() ? &g.root : g.find (patch);
    if (p == nullptr) return noPatch (patch);
    const auto parsed = parseWire (text);
    if (! parsed) return Message::error (parsed.error().id, placeIn (patch, "wires"), parsed.error().text, "write a wire such as a.out -> b.in");

    const auto wanted = toText (*parsed);
    for (const auto& w : p->wires)
        if (toText (w) == wanted) return w.id;
    const auto same = toText (innermost (g, *p, *parsed));
    for (const auto& w : p->wires)
        if (toText (innermost (g, *p, w)) == same) return w.id;

    std::vector<std::string> all;
    for (const auto& w : p->wires)
        all.push_back (toText (w));
    return Message::error ("edit/unknown_wire", placeIn (patch, "wires"), "there is no wire " + quote (text), suggestion (wanted, all));
}

}   // namespace tactus::graph
