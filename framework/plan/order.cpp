// SPDX-License-Identifier: MIT
#include "order.hpp"
#include "carries.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <queue>

namespace tactus::plan
{

/// Tarjan 1972, without recursion, so that a chain of 10^5 nodes does not overflow the stack.
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

namespace
{
std::size_t at (int i) { return static_cast<std::size_t> (i); }

/// A bypassed node passes its inputs on at once, so it does not peek.
bool peeks (const FlatNode& n) { return n.type->peek != nullptr && ! n.bypass; }

/// What runs as one in the section where a wire stands: nodes by their numbers, and after them the sections.
struct Blocks
{
    const Flat& flat;

    std::size_t size() const { return flat.nodes.size() + flat.sections.size(); }
    int ofSection (int s) const { return static_cast<int> (flat.nodes.size()) + s; }

    /// The node, or the section it is in, as seen from the section around.
    int of (int node, int around) const
    {
        int block = node;
        for (int s = flat.nodes[at (node)].section; s != around; s = flat.section (s).around)
            block = ofSection (s);
        return block;
    }
    int from (const FlatWire& w) const { return of (w.from->node, w.section); }
    int to (const FlatWire& w) const { return of (w.to.node, w.section); }

    bool isSection (int block) const { return block >= static_cast<int> (flat.nodes.size()); }
    int section (int block) const { return block - static_cast<int> (flat.nodes.size()); }
    const std::string& path (int block) const { return isSection (block) ? flat.section (section (block)).path : flat.nodes[at (block)].path; }
    int around (int block) const { return isSection (block) ? flat.section (section (block)).around : flat.nodes[at (block)].section; }

    /// True if the wire makes its end wait for its start within a tick. What leaves a section waits for all of it.
    bool bind (const FlatWire& w) const
    {
        if (! w.from || w.delay > 0) return false;
        const auto& start = flat.node (*w.from);
        return start.section != w.section || ! peeks (start);
    }
};

/// All blocks by their paths. The first eight characters settle nearly all comparisons.
std::vector<int> sortedByPath (const Blocks& blocks)
{
    struct Entry
    {
        std::uint64_t head;
        int block;
    };
    std::vector<Entry> entries;
    entries.reserve (blocks.size());
    for (int b = 0; b < static_cast<int> (blocks.size()); ++b)
    {
        const auto& path = blocks.path (b);
        std::uint64_t head = 0;
        for (std::size_t i = 0; i < 8; ++i)
            head = head << 8 | (i < path.size() ? static_cast<unsigned char> (path[i]) : 0u);
        entries.push_back ({ head, b });
    }
    std::ranges::sort (entries, [&] (const Entry& a, const Entry& b)
                       {
        if (a.head != b.head) return a.head < b.head;
        const int order = blocks.path (a.block).compare (blocks.path (b.block));
        return order != 0 ? order < 0 : a.block < b.block; });

    std::vector<int> sorted;
    sorted.reserve (entries.size());
    for (const auto& e : entries)
        sorted.push_back (e.block);
    return sorted;
}

/// Steps from the nearest block without inputs to each; what is far from the sources is near the end of a chain.
std::vector<int> distances (const Blocks& blocks, const Grouped<int>& next)
{
    const auto size = blocks.size();
    std::vector<bool> fed (size, false);
    for (const auto& w : blocks.flat.wires)
        if (w.from) fed[at (blocks.to (w))] = true;

    std::vector<int> distance (size, static_cast<int> (size));
    std::queue<int> open;
    for (int b = 0; b < static_cast<int> (size); ++b)
        if (! fed[at (b)] || (! blocks.isSection (b) && peeks (blocks.flat.nodes[at (b)])))
        {
            distance[at (b)] = 0;
            open.push (b);
        }
    for (; ! open.empty(); open.pop())
        for (const int b : next[at (open.front())])
            if (distance[at (b)] > distance[at (open.front())] + 1)
            {
                distance[at (b)] = distance[at (open.front())] + 1;
                open.push (b);
            }
    return distance;
}

/// Wires that bind, by the block they start from.
using Outgoing = Grouped<const FlatWire*>;

/// The shortest loop through `start` that stays within its component, as wires.
std::vector<const FlatWire*> loopThrough (int start, const Blocks& blocks, const Outgoing& out, const std::vector<int>& component)
{
    std::map<int, const FlatWire*> by;   // how each block was reached
    std::queue<int> open;
    open.push (start);
    for (; ! open.empty() && ! by.contains (start); open.pop())
        for (const auto* w : out[at (open.front())])
            if (const int to = blocks.to (*w); component[at (to)] == component[at (start)] && by.try_emplace (to, w).second) open.push (to);

    std::vector<const FlatWire*> loop;
    for (int b = start; loop.empty() || b != start;)
    {
        loop.push_back (by.at (b));
        b = blocks.from (*by.at (b));
    }
    std::ranges::reverse (loop);
    return loop;
}

std::string textOf (const Flat& flat, const FlatWire& w, const char* arrow = " -> ") { return flat.nameOf (*w.from) + arrow + flat.nameOf (w.to); }

void reportLoops (Flat& flat, const Blocks& blocks, const Grouped<int>& next)
{
    const auto component = components (blocks.size(), next);
    const auto distance = distances (blocks, next);
    const Outgoing outgoing (blocks.size(), [&] (auto visit)
                             {
                                 for (const auto& w : flat.wires)
                                     if (blocks.bind (w)) visit (blocks.from (w), &w); });
    std::vector<int> members (blocks.size(), 0);
    for (const int c : component)
        ++members[at (c)];
    std::vector<bool> reported (blocks.size(), false);

    for (const int b : sortedByPath (blocks))
    {
        const auto c = at (component[at (b)]);
        const bool loops = members[c] > 1 || std::ranges::count (next[at (b)], b) > 0;
        if (! loops || reported[c]) continue;
        reported[c] = true;

        const auto loop = loopThrough (b, blocks, outgoing, component);
        std::string chain, whole;
        for (const auto* w : loop)
        {
            chain += (chain.empty() ? "" : ", then ") + textOf (flat, *w);
            if (const int from = blocks.from (*w); blocks.isSection (from)) whole += "; '" + blocks.path (from) + "' runs as a whole, so nothing comes out of it before all that goes in is there";
        }

        // A delay costs least on the wire that leads back: from far from the sources to near them.
        const auto* back = *std::ranges::max_element (loop, {}, [&] (const FlatWire* w)
                                                      { return distance[at (blocks.from (*w))] - distance[at (blocks.to (*w))]; });
        const auto origin = back->origin;
        flat.error ("graph/loop", origin, "a loop without a delay: " + chain + whole, "put a delay where it goes back: \"" + textOf (flat, *back, " -> [1] -> ") + "\"");
    }
}
}   // namespace

Order order (Flat& flat)
{
    const Blocks blocks { flat };
    const auto size = blocks.size();
    const Grouped<int> next (size, [&] (auto visit)
                             {
                                 for (const auto& w : flat.wires)
                                     if (blocks.bind (w)) visit (blocks.from (w), blocks.to (w)); });
    std::vector<int> waiting (size, 0);
    for (std::size_t b = 0; b < size; ++b)
        for (const int m : next[b])
            ++waiting[at (m)];

    const auto by_path = sortedByPath (blocks);
    std::vector<int> rank (size);
    for (std::size_t r = 0; r < size; ++r)
        rank[at (by_path[r])] = static_cast<int> (r);

    std::priority_queue<int, std::vector<int>, std::greater<>> ready;   // ranks
    for (std::size_t b = 0; b < size; ++b)
        if (waiting[b] == 0) ready.push (rank[b]);

    Order ordered (flat.sections.size());
    ordered.front().reserve (size);
    std::size_t done = 0;
    for (; ! ready.empty(); ++done)
    {
        const int b = by_path[at (ready.top())];
        ready.pop();
        if (const int around = blocks.around (b); around >= 0) ordered[at (around)].push_back (blocks.isSection (b) ? Step { .section = blocks.section (b) } : Step { .node = b });
        for (const int m : next[at (b)])
            if (--waiting[at (m)] == 0) ready.push (rank[at (m)]);
    }
    if (done < size) reportLoops (flat, blocks, next);
    return ordered;
}

namespace
{
/// How long, in ticks of the graph, what enters a section from one around it may wait until the section runs.
int waitOf (const Flat& flat, int around, int section) { return flat.ticksOf (section) - flat.ticksOf (around); }
}   // namespace

std::int64_t delayOf (const Flat& flat, const PortUnits& units, const FlatWire& w)
{
    auto delay = std::int64_t { w.delay } * flat.ticksOf (w.section);
    if (w.crosses && carriedBy (flat, units, w) == Carries::signal)
        for (const int s : flat.sectionsBetween (w.section, flat.node (*w.from).section))
            if (flat.section (s).linear) delay += flat.ticksOf (s);
    return delay;
}

std::vector<PathDelay> pathDelays (const Flat& flat, const PortUnits& units, const std::vector<int>& node_delays)
{
    struct Edge
    {
        int to;
        std::int64_t shortest, longest;
    };
    const auto acts = [&] (int n)
    { return flat.nodes[at (n)].type->effort != nullptr; };
    const auto reads = [&] (int n)
    { return flat.nodes[at (n)].type->bind != nullptr && ! acts (n); };

    const auto size = flat.nodes.size();
    const auto any = [size] (auto is)
    {
        for (std::size_t n = 0; n < size; ++n)
            if (is (static_cast<int> (n))) return true;
        return false;
    };
    if (! any (acts) || ! any (reads)) return {};

    const auto edgeOf = [&] (const FlatWire& w)
    {
        const auto from = at (w.from->node);
        const auto delay = delayOf (flat, units, w) + std::int64_t { node_delays[from] } * flat.ticksOf (flat.nodes[from].section);
        return Edge { w.to.node, delay, delay + waitOf (flat, w.section, flat.nodes[at (w.to.node)].section) };
    };
    const Grouped<Edge> edges (size, [&] (auto visit)
                               {
                                   for (const auto& w : flat.wires)
                                       if (w.from) visit (w.from->node, edgeOf (w)); });
    const Grouped<int> next (size, [&] (auto visit)
                             {
                                 for (const auto& w : flat.wires)
                                     if (w.from) visit (w.from->node, w.to.node); });

    // Components come numbered sinks first; walking them from high to low visits each node after all that lead to it.
    const auto component = components (size, next);
    std::vector<int> members (size, 0);
    for (const int c : component)
        ++members[at (c)];

    // What a source does not reach costs nothing: of many sources each mostly has a few nodes of its own.
    struct Reach
    {
        std::int64_t shortest = -1, longest = -1;   // -1: not
        bool recirculates = false;
    };
    std::vector<Reach> reach (size);
    std::vector<int> reached;
    std::vector<PathDelay> found;
    for (int source = 0; source < static_cast<int> (size); ++source)
    {
        if (! reads (source)) continue;
        for (const int n : reached)
            reach[at (n)] = {};
        reached = { source };
        reach[at (source)] = { 0, waitOf (flat, 0, flat.nodes[at (source)].section), false };

        using Arrival = std::pair<std::int64_t, int>;
        std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> open;
        for (open.emplace (0, source); ! open.empty();)
        {
            const auto [delay, n] = open.top();
            open.pop();
            if (delay > reach[at (n)].shortest) continue;
            for (const auto& e : edges[at (n)])
            {
                auto& shortest = reach[at (e.to)].shortest;
                if (shortest >= 0 && delay + e.shortest >= shortest) continue;
                if (shortest < 0) reached.push_back (e.to);
                shortest = delay + e.shortest;
                open.emplace (shortest, e.to);
            }
        }
        std::ranges::sort (reached, [&] (int a, int b)
                           { return component[at (a)] != component[at (b)] ? component[at (a)] > component[at (b)] : a < b; });
        for (const int n : reached)
        {
            auto& here = reach[at (n)];
            if (members[at (component[at (n)])] > 1 || std::ranges::count (next[at (n)], n) > 0) here.recirculates = true;
            here.longest = std::max (here.longest, here.shortest);
            for (const auto& e : edges[at (n)])
            {
                auto& there = reach[at (e.to)];
                if (component[at (e.to)] != component[at (n)]) there.longest = std::max (there.longest, here.longest + e.longest);
                there.recirculates = there.recirculates || here.recirculates;
            }
        }
        for (const int sink : reached)
            if (acts (sink)) found.push_back ({ flat.nodes[at (source)].path, flat.nodes[at (sink)].path, reach[at (sink)].shortest, reach[at (sink)].longest, reach[at (sink)].recirculates });
    }
    std::ranges::sort (found, {}, [] (const PathDelay& d)
                       { return std::pair { d.source, d.sink }; });
    return found;
}

}   // namespace tactus::plan
