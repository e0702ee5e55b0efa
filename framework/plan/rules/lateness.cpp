// SPDX-License-Identifier: MIT
#include "lateness.hpp"
#include "order.hpp"

#include <tactus/graph/endpoint_text.hpp>

#include <algorithm>
#include <numeric>

namespace tactus::plan
{

namespace
{
constexpr int none = -1;

/// For each node: the start node from which it can be reached along `next`, or none. If there are several, the first by path.
template <typename Begins>
std::vector<int> reachedFrom (const Flat& flat, const Grouped<int>& next, Begins begins)
{
    std::vector<int> by_path (flat.nodes.size()), from (flat.nodes.size(), none), open;
    std::iota (by_path.begin(), by_path.end(), 0);
    std::erase_if (by_path, [&] (int n) { return ! begins (flat.node (n)); });
    std::ranges::sort (by_path, {}, [&] (int n) -> const std::string& { return flat.node (n).path; });
    for (const int start : by_path)
    {
        if (from[at (start)] == none) open.push_back (start);
        from[at (start)] = start;
        while (! open.empty())
        {
            const int n = open.back();
            open.pop_back();
            for (const int m : next[at (n)])
                if (from[at (m)] == none)
                {
                    from[at (m)] = start;
                    open.push_back (m);
                }
        }
    }
    return from;
}

std::string ticks (std::int64_t n) { return std::to_string (n) + (n == 1 ? " tick" : " ticks"); }
}   // namespace

void warnOfDelays (Flat& flat, const PortUnits& units, const std::vector<int>& node_delays)
{
    const auto isLate = [&] (const FlatWire& w) {
        if (! w.from) return false;
        const bool comes_late = node_delays[at (w.from->node)] > 0 && flat.node (*w.from).type->effort == nullptr;
        return comes_late || delayOf (flat, units, w) > 0;
    };
    if (std::ranges::none_of (flat.wires, isLate)) return;

    const Grouped<int> next (flat.nodes.size(), [&] (auto visit) {
        for (const auto& w : flat.wires)
            if (w.from) visit (w.from->node, w.to.node);
    });
    const Grouped<int> back (flat.nodes.size(), [&] (auto visit) {
        for (const auto& w : flat.wires)
            if (w.from) visit (w.to.node, w.from->node);
    });
    const auto acts = [] (const FlatNode& n) { return n.runs() && n.type->effort != nullptr; };
    const auto source = reachedFrom (flat, next, [&] (const FlatNode& n) { return n.runs() && n.type->bind != nullptr && n.type->effort == nullptr; });
    const auto sink = reachedFrom (flat, back, acts);
    const auto component = components (flat.nodes.size(), next);

    std::vector<bool> reported (flat.nodes.size(), false);
    const auto wires = flat.wires.size();
    for (std::size_t i = 0; i < wires; ++i)
    {
        const auto& w = flat.wires[i];
        if (! isLate (w)) continue;
        const int from = w.from->node, to = w.to.node;
        if (source[at (from)] == none || sink[at (to)] == none || component[at (from)] == component[at (to)]) continue;

        const auto path = " the path from '" + flat.node (source[at (from)]).path + "' to '" + flat.node (sink[at (to)]).path + "' by ";
        const std::string cost = "each tick of delay costs stiffness that the hand can feel; ";
        const auto& node = flat.node (from);
        const auto written = std::int64_t { w.delay } * flat.ticksOf (w.section);
        if (written > 0)
            flat.warn ("rate/late", w.origin, "\"" + graph::toText (*w.written) + "\" delays" + path + ticks (written),
                       cost + "remove the delay from the wire");
        if (const auto lines = delayOf (flat, units, w) - written; lines > 0)
            flat.warn ("rate/late", w.origin, "\"" + graph::toText (*w.written) + "\" leaves a section with linear hold, which delays" + path + ticks (lines),
                       cost + "write \"hold\": \"latch\", which answers within the tick");
        if (node_delays[at (from)] > 0 && ! reported[at (from)])
        {
            reported[at (from)] = true;
            flat.warn ("rate/late", node.origin,
                       "'" + node.path + "' (" + std::string (node.type->info.id) + ") delays" + path
                           + ticks (std::int64_t { node_delays[at (from)] } * flat.ticksOf (node.section)),
                       cost + "bypass the node, or wire around it");
        }
    }
}

}   // namespace tactus::plan
