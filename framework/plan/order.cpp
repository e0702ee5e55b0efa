// SPDX-License-Identifier: MIT
#include "order.hpp"
#include "grouped.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <queue>
#include <ranges>

namespace tactus::plan
{

namespace
{
/// Strongly connected components of a graph given by successors, numbered so that each comes after those it leads to
/// (Tarjan 1972, without recursion, so that a chain of 10^5 nodes does not overflow the stack).
std::vector<int> components (std::size_t size, const Grouped<int>& next)
{
    std::vector<int> number (size, -1), low (size, 0), component (size, -1), path;
    std::vector<std::pair<int, std::size_t>> calls;
    int visited = 0, found = 0;

    for (int start = 0; start < static_cast<int> (size); ++start)
    {
        if (number[static_cast<std::size_t> (start)] >= 0) continue;
        calls.emplace_back (start, 0);
        while (! calls.empty())
        {
            const int v = calls.back().first;
            const auto i = static_cast<std::size_t> (v);
            if (calls.back().second == 0)
            {
                number[i] = low[i] = visited++;
                path.push_back (v);
            }
            if (calls.back().second < next[i].size())
            {
                const int w = next[i][calls.back().second++];
                const auto j = static_cast<std::size_t> (w);
                if (number[j] < 0)
                    calls.emplace_back (w, 0);
                else if (component[j] < 0)
                    low[i] = std::min (low[i], number[j]);
                continue;
            }
            calls.pop_back();
            if (! calls.empty())
            {
                const auto parent = static_cast<std::size_t> (calls.back().first);
                low[parent] = std::min (low[parent], low[i]);
            }
            if (low[i] == number[i])
            {
                while (component[i] < 0)
                {
                    component[static_cast<std::size_t> (path.back())] = found;
                    path.pop_back();
                }
                ++found;
            }
        }
    }
    return component;
}

std::size_t at (int i) { return static_cast<std::size_t> (i); }

/// A bypassed node passes its inputs on at once, so it does not peek.
bool peeks (const FlatNode& n) { return n.type->peek != nullptr && ! n.bypass; }

/// All nodes by their paths. The first eight characters settle nearly all comparisons.
std::vector<int> sortedByPath (const Flat& flat)
{
    struct Entry
    {
        std::uint64_t head;
        int node;
    };
    std::vector<Entry> entries;
    entries.reserve (flat.nodes.size());
    for (const auto& n : flat.nodes)
    {
        std::uint64_t head = 0;
        for (std::size_t i = 0; i < 8; ++i)
            head = head << 8 | (i < n.path.size() ? static_cast<unsigned char> (n.path[i]) : 0u);
        entries.push_back ({ head, static_cast<int> (entries.size()) });
    }
    std::ranges::sort (entries, [&] (const Entry& a, const Entry& b)
                       { return a.head != b.head ? a.head < b.head : flat.nodes[at (a.node)].path < flat.nodes[at (b.node)].path; });

    std::vector<int> sorted;
    sorted.reserve (entries.size());
    for (const auto& e : entries)
        sorted.push_back (e.node);
    return sorted;
}

/// True if the wire makes its end wait for its start within a tick.
bool binds (const Flat& flat, const FlatWire& w) { return w.from && w.delay == 0 && ! peeks (flat.node (*w.from)); }

/// Steps from the nearest node without inputs to each node; what is far from the sources is near the end of a chain.
std::vector<int> distances (const Flat& flat, const Grouped<int>& next)
{
    std::vector<bool> fed (flat.nodes.size(), false);
    for (const auto& w : flat.wires)
        if (w.from) fed[at (w.to.node)] = true;

    std::vector<int> distance (flat.nodes.size(), static_cast<int> (flat.nodes.size()));
    std::queue<int> open;
    for (int n = 0; n < static_cast<int> (flat.nodes.size()); ++n)
        if (! fed[at (n)] || peeks (flat.nodes[at (n)]))
        {
            distance[at (n)] = 0;
            open.push (n);
        }
    for (; ! open.empty(); open.pop())
        for (const int n : next[at (open.front())])
            if (distance[at (n)] > distance[at (open.front())] + 1)
            {
                distance[at (n)] = distance[at (open.front())] + 1;
                open.push (n);
            }
    return distance;
}

/// Wires that bind, by the node they start from.
using Outgoing = Grouped<const FlatWire*>;

/// The shortest loop through `start` that stays within its component, as wires.
std::vector<const FlatWire*> loopThrough (int start, const Outgoing& out, const std::vector<int>& component)
{
    std::map<int, const FlatWire*> by;   // how each node was reached
    std::queue<int> open;
    open.push (start);
    for (; ! open.empty() && ! by.contains (start); open.pop())
        for (const auto* w : out[at (open.front())])
            if (component[at (w->to.node)] == component[at (start)] && by.try_emplace (w->to.node, w).second) open.push (w->to.node);

    std::vector<const FlatWire*> loop;
    for (int n = start; loop.empty() || n != start;)
    {
        loop.push_back (by.at (n));
        n = by.at (n)->from->node;
    }
    std::ranges::reverse (loop);
    return loop;
}

std::string textOf (const Flat& flat, const FlatWire& w, const char* arrow = " -> ") { return flat.nameOf (*w.from) + arrow + flat.nameOf (w.to); }

void reportLoops (Flat& flat, const Grouped<int>& next)
{
    const auto component = components (flat.nodes.size(), next);
    const auto distance = distances (flat, next);
    const Outgoing outgoing (flat.nodes.size(), [&] (auto visit)
                             {
                                 for (const auto& w : flat.wires)
                                     if (binds (flat, w)) visit (w.from->node, &w); });
    std::vector<int> members (flat.nodes.size(), 0);
    for (const int c : component)
        ++members[at (c)];
    std::vector<bool> reported (flat.nodes.size(), false);

    for (const int n : sortedByPath (flat))
    {
        const auto c = at (component[at (n)]);
        const bool loops = members[c] > 1 || std::ranges::count (next[at (n)], n) > 0;
        if (! loops || reported[c]) continue;
        reported[c] = true;

        const auto loop = loopThrough (n, outgoing, component);
        std::string chain;
        for (const auto* w : loop)
            chain += (chain.empty() ? "" : ", then ") + textOf (flat, *w);

        // A delay costs least on the wire that leads back: from far from the sources to near them.
        const auto* back = *std::ranges::max_element (loop, {}, [&] (const FlatWire* w)
                                                      { return distance[at (w->from->node)] - distance[at (w->to.node)]; });
        const auto origin = back->origin;
        flat.error ("graph/loop", origin, "a loop without a delay: " + chain, "put a delay where it goes back: \"" + textOf (flat, *back, " -> [1] -> ") + "\"");
    }
}
}   // namespace

std::vector<int> order (Flat& flat)
{
    const auto size = flat.nodes.size();
    std::vector<int> waiting (size, 0);
    const Grouped<int> next (size, [&] (auto visit)
                             {
                                 for (const auto& w : flat.wires)
                                     if (binds (flat, w)) visit (w.from->node, w.to.node); });
    for (std::size_t n = 0; n < size; ++n)
        for (const int m : next[n])
            ++waiting[at (m)];

    const auto by_path = sortedByPath (flat);
    std::vector<int> rank (size);
    for (std::size_t r = 0; r < size; ++r)
        rank[at (by_path[r])] = static_cast<int> (r);

    std::priority_queue<int, std::vector<int>, std::greater<>> ready;   // ranks
    for (std::size_t n = 0; n < size; ++n)
        if (waiting[n] == 0) ready.push (rank[n]);

    std::vector<int> ordered;
    ordered.reserve (size);
    while (! ready.empty())
    {
        const int n = by_path[at (ready.top())];
        ready.pop();
        ordered.push_back (n);
        for (const int m : next[at (n)])
            if (--waiting[at (m)] == 0) ready.push (rank[at (m)]);
    }
    if (ordered.size() < size) reportLoops (flat, next);
    return ordered;
}

std::vector<PathDelay> pathDelays (const Flat& flat, const std::vector<int>& node_delays)
{
    struct Edge
    {
        int to, delay;
    };
    const auto acts = [&] (int n)
    { return flat.nodes[at (n)].type->effort != nullptr; };
    const auto reads = [&] (int n)
    { return flat.nodes[at (n)].type->bind != nullptr && ! acts (n); };

    const auto size = flat.nodes.size();
    const auto any = [size] (auto is)
    { return std::ranges::any_of (std::views::iota (0, static_cast<int> (size)), is); };
    if (! any (acts) || ! any (reads)) return {};

    const Grouped<Edge> edges (size, [&] (auto visit)
                               {
                                   for (const auto& w : flat.wires)
                                       if (w.from) visit (w.from->node, Edge { w.to.node, w.delay + node_delays[at (w.from->node)] }); });
    const Grouped<int> next (size, [&] (auto visit)
                             {
                                 for (const auto& w : flat.wires)
                                     if (w.from) visit (w.from->node, w.to.node); });

    // Components come numbered sinks first; walking them from high to low visits each node after all that lead to it.
    const auto component = components (size, next);
    std::vector<int> members (size, 0), walk (size);
    for (const int c : component)
        ++members[at (c)];
    std::iota (walk.begin(), walk.end(), 0);
    std::ranges::stable_sort (walk, std::greater {}, [&] (int n)
                              { return component[at (n)]; });

    std::vector<PathDelay> found;
    for (int source = 0; source < static_cast<int> (size); ++source)
    {
        if (! reads (source)) continue;

        constexpr int unreached = -1;
        std::vector<int> shortest (size, unreached), longest (size, unreached);
        std::vector<bool> recirculates (size, false);
        shortest[at (source)] = longest[at (source)] = 0;

        std::priority_queue<std::pair<int, int>, std::vector<std::pair<int, int>>, std::greater<>> open;
        for (open.emplace (0, source); ! open.empty();)
        {
            const auto [delay, n] = open.top();
            open.pop();
            if (delay > shortest[at (n)]) continue;
            for (const auto& e : edges[at (n)])
                if (shortest[at (e.to)] == unreached || delay + e.delay < shortest[at (e.to)])
                {
                    shortest[at (e.to)] = delay + e.delay;
                    open.emplace (delay + e.delay, e.to);
                }
        }
        for (const int n : walk)
        {
            if (shortest[at (n)] == unreached) continue;
            if (members[at (component[at (n)])] > 1 || std::ranges::count (next[at (n)], n) > 0) recirculates[at (n)] = true;
            longest[at (n)] = std::max (longest[at (n)], shortest[at (n)]);
            for (const auto& e : edges[at (n)])
            {
                if (component[at (e.to)] != component[at (n)]) longest[at (e.to)] = std::max (longest[at (e.to)], longest[at (n)] + e.delay);
                recirculates[at (e.to)] = recirculates[at (e.to)] || recirculates[at (n)];
            }
        }
        for (int sink = 0; sink < static_cast<int> (size); ++sink)
            if (acts (sink) && shortest[at (sink)] != unreached)
                found.push_back ({ flat.nodes[at (source)].path, flat.nodes[at (sink)].path, shortest[at (sink)], longest[at (sink)], recirculates[at (sink)] });
    }
    std::ranges::sort (found, {}, [] (const PathDelay& d)
                       { return std::pair { d.source, d.sink }; });
    return found;
}

}   // namespace tactus::plan
