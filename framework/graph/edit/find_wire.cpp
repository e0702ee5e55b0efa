// SPDX-License-Identifier: MIT
#include "find_wire.hpp"

#include "refusals.hpp"
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/inside.hpp>

#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <vector>

namespace tactus::graph
{

namespace
{
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
