// SPDX-License-Identifier: MIT
#include "order.hpp"
#include "signal_kind.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <queue>

namespace tactus::plan
{

/// Tarjan 1972, without recursion, so a chain of 10^5 nodes does not overflow the stack.
std::vector<int> components (std::size_t size, const Grouped<int>& next)
{
    std::vector<int> number (size, -1), low (size, 0), component (size, -1), path;
    std::vector<std::pair<int, std::size_t>> calls;
    int visited = 0, found = 0;

    for (int start = 0; start < static_cast<int> (size); ++start)
    {
        if (number[at (start)] >= 0) continue;
        calls.emplace_back (start, 0);
        while (! calls.empty())
        {
            const int v = calls.back().first;
            const auto i = at (v);
            if (calls.back().second == 0)
            {
                number[i] = low[i] = visited++;
                path.push_back (v);
            }
            if (calls.back().second < next[i].size())
            {
                const int w = next[i][calls.back().second++];
                const auto j = at (w);
                if (number[j] < 0)
                    calls.emplace_back (w, 0);
                else if (component[j] < 0)
                    low[i] = std::min (low[i], number[j]);
                continue;
            }
            calls.pop_back();
            if (! calls.empty())
            {
                const auto parent = at (calls.back().first);
                low[parent] = std::min (low[parent], low[i]);
            }
            if (low[i] == number[i])
            {
                while (component[i] < 0)
                {
                    component[at (path.back())] = found;
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
/// A bypassed node passes its inputs on within the tick, so it does not peek.
bool peeks (const FlatNode& n) { return n.type->peek != nullptr && ! n.bypass; }

/// The blocks that run as a whole within a section: nodes by their numbers, then sections.
struct Blocks
{
    const Flat& flat;

    std::size_t size() const { return flat.nodes.size() + flat.sections.size(); }
    int ofSection (int s) const { return flat.nodeCount() + s; }

    /// The block of a node as seen from the section `around`: the node itself, or the section that contains it.
    int of (int node, int around) const
    {
        int block = node;
        for (int s = flat.node (node).section; s != around; s = flat.section (s).around)
            block = ofSection (s);
        return block;
    }
    int from (const FlatWire& w) const { return of (w.from->node, w.section); }
    int to (const FlatWire& w) const { return of (w.to.node, w.section); }

    bool isSection (int block) const { return block >= flat.nodeCount(); }
    int section (int block) const { return block - flat.nodeCount(); }
    const std::string& path (int block) const { return isSection (block) ? flat.section (section (block)).path : flat.node (block).path; }
    int around (int block) const { return isSection (block) ? flat.section (section (block)).around : flat.node (block).section; }

    /// True if the end of the wire must wait for its start within a tick. A wire out of a section waits for the whole section.
    bool bind (const FlatWire& w) const
    {
        if (! w.from || w.delay > 0) return false;
        const auto& start = flat.node (*w.from);
        return start.section != w.section || ! peeks (start);
    }
};

/// All blocks sorted by path. The first eight characters decide nearly all comparisons.
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
    std::ranges::sort (entries, [&] (const Entry& a, const Entry& b) {
        if (a.head != b.head) return a.head < b.head;
        const int order = blocks.path (a.block).compare (blocks.path (b.block));
        return order != 0 ? order < 0 : a.block < b.block;
    });

    std::vector<int> sorted;
    sorted.reserve (entries.size());
    for (const auto& e : entries)
        sorted.push_back (e.block);
    return sorted;
}

/// Number of steps to each block from the nearest block without inputs. A block with a large distance is near the end of a
/// chain.
std::vector<int> distances (const Blocks& blocks, const Grouped<int>& next)
{
    const auto size = blocks.size();
    std::vector<bool> fed (size, false);
    for (const auto& w : blocks.flat.wires)
        if (w.from) fed[at (blocks.to (w))] = true;

    std::vector<int> distance (size, static_cast<int> (size));
    std::queue<int> open;
    for (int b = 0; b < static_cast<int> (size); ++b)
        if (! fed[at (b)] || (! blocks.isSection (b) && peeks (blocks.flat.node (b))))
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

/// Binding wires, by the block they start from.
using Outgoing = Grouped<const FlatWire*>;

/// The shortest loop through `start` within its component, as wires.
std::vector<const FlatWire*> loopThrough (int start, const Blocks& blocks, const Outgoing& out, const std::vector<int>& component)
{
    std::map<int, const FlatWire*> by;   // by block: the wire that reached it
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
    const Outgoing outgoing (blocks.size(), [&] (auto visit) {
        for (const auto& w : flat.wires)
            if (blocks.bind (w)) visit (blocks.from (w), &w);
    });
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
            if (const int from = blocks.from (*w); blocks.isSection (from))
                whole += "; '" + blocks.path (from) + "' runs as a whole, so it has no output before all of its inputs have arrived";
        }

        // A delay costs least on the wire that leads back: from a block far from the sources to a block near them.
        const auto* back = *std::ranges::max_element (loop, {},
                                                      [&] (const FlatWire* w) { return distance[at (blocks.from (*w))] - distance[at (blocks.to (*w))]; });
        const auto origin = back->origin;
        flat.error ("graph/loop", origin, "a loop without a delay: " + chain + whole,
                    "put a delay on the wire that leads back: \"" + textOf (flat, *back, " -> [1] -> ") + "\"");
    }
}
}   // namespace

Order order (Flat& flat)
{
    const Blocks blocks { flat };
    const auto size = blocks.size();
    const Grouped<int> next (size, [&] (auto visit) {
        for (const auto& w : flat.wires)
            if (blocks.bind (w)) visit (blocks.from (w), blocks.to (w));
    });
    std::vector<int> waiting (size, 0);
    for (std::size_t b = 0; b < size; ++b)
        for (const int m : next[b])
            ++waiting[at (m)];

    const auto by_path = sortedByPath (blocks);
    std::vector<int> rank (size);
    for (std::size_t r = 0; r < size; ++r)
        rank[at (by_path[r])] = static_cast<int> (r);

    std::priority_queue<int, std::vector<int>, std::greater<>> ready;   // ranks of the blocks that can run next
    for (std::size_t b = 0; b < size; ++b)
        if (waiting[b] == 0) ready.push (rank[b]);

    Order ordered (flat.sections.size());
    ordered.front().reserve (size);
    std::size_t done = 0;
    for (; ! ready.empty(); ++done)
    {
        const int b = by_path[at (ready.top())];
        ready.pop();
        if (const int around = blocks.around (b); around >= 0)
            ordered[at (around)].push_back (blocks.isSection (b) ? Step { .section = blocks.section (b) } : Step { .node = b });
        for (const int m : next[at (b)])
            if (--waiting[at (m)] == 0) ready.push (rank[at (m)]);
    }
    if (done < size) reportLoops (flat, blocks, next);
    return ordered;
}

namespace
{
/// The longest time that a value which enters a section waits until the section runs, in ticks of the graph.
int waitOf (const Flat& flat, int around, int section) { return flat.ticksOf (section) - flat.ticksOf (around); }
}   // namespace

std::int64_t delayOf (const Flat& flat, const PortUnits& units, const FlatWire& w)
{
    auto delay = std::int64_t { w.delay } * flat.ticksOf (w.section);
    if (w.crosses && carriedBy (flat, units, w) == SignalKind::signal)
        for (const int s : flat.sectionsBetween (w.section, flat.node (*w.from).section))
            if (flat.section (s).linear) delay += flat.ticksOf (s);
    return delay;
}

namespace
{
/// Finds the path delays between device sources and device sinks.
class PathSearch
{
public:
    PathSearch (const Flat& f, const PortUnits& u, const std::vector<int>& delays)
        : flat (f), units (u), node_delays (delays), wires (f.nodes.size(), [&] (auto visit) {
              for (int i = 0; const auto& w : f.wires)
              {
                  if (w.from) visit (w.from->node, i);
                  ++i;
              }
          }),
          next (f.nodes.size(), [&] (auto visit) {
              for (const auto& w : f.wires)
                  if (w.from) visit (w.from->node, w.to.node);
          }),
          component (components (f.nodes.size(), next)), members (f.nodes.size(), 0), reach (f.nodes.size())
    {
        for (const int c : component)
            ++members[at (c)];
    }

    /// Adds the delays from a source to all sinks that it reaches.
    void addPaths (int source, std::vector<PathDelay>& found)
    {
        findShortest (source);
        // A component has a higher number than those it leads to, so from high to low, each node comes after all nodes that lead
        // to it.
        std::ranges::sort (reached, [&] (int a, int b) { return component[at (a)] != component[at (b)] ? component[at (a)] > component[at (b)] : a < b; });
        for (const int n : reached)
            spread (n);
        for (const int sink : reached)
            if (acts (flat, sink))
                found.push_back (
                    { flat.node (source).path, flat.node (sink).path, reach[at (sink)].shortest, reach[at (sink)].longest, reach[at (sink)].recirculates });
    }

    static bool acts (const Flat& flat, int n) { return flat.node (n).type->effort != nullptr; }
    static bool reads (const Flat& flat, int n) { return flat.node (n).type->bind != nullptr && ! acts (flat, n); }

private:
    struct Edge
    {
        int to;
        std::int64_t shortest, longest;
    };

    struct Reach
    {
        std::int64_t shortest = -1, longest = -1;   // -1: not reached
        bool recirculates = false;
    };

    const Flat& flat;
    const PortUnits& units;
    const std::vector<int>& node_delays;
    Grouped<int> wires, next;              // by node: the wires that start there, and the nodes where they end
    std::vector<int> component, members;   // by node: its component; by component: its number of nodes
    std::vector<Reach> reach;              // as seen from the current source
    std::vector<int> reached;              // from the current source; only these are reset for the next one, because most sources reach few nodes

    Edge edgeOf (int wire) const
    {
        const auto& w = flat.wires[at (wire)];
        const auto& from = flat.node (w.from->node);
        const auto delay = delayOf (flat, units, w) + std::int64_t { node_delays[at (w.from->node)] } * flat.ticksOf (from.section);
        return { w.to.node, delay, delay + waitOf (flat, w.section, flat.node (w.to).section) };
    }

    /// Dijkstra's algorithm.
    void findShortest (int source)
    {
        for (const int n : reached)
            reach[at (n)] = {};
        reached = { source };
        reach[at (source)] = { 0, waitOf (flat, 0, flat.node (source).section), false };

        using Arrival = std::pair<std::int64_t, int>;
        std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> open;
        for (open.emplace (0, source); ! open.empty();)
        {
            const auto [delay, n] = open.top();
            open.pop();
            if (delay > reach[at (n)].shortest) continue;
            for (const int wire : wires[at (n)])
            {
                const auto e = edgeOf (wire);
                auto& shortest = reach[at (e.to)].shortest;
                if (shortest >= 0 && delay + e.shortest >= shortest) continue;
                if (shortest < 0) reached.push_back (e.to);
                shortest = delay + e.shortest;
                open.emplace (shortest, e.to);
            }
        }
    }

    /// Passes two things on from a node to the nodes that follow: its longest delay, and whether there is a loop on the way to it.
    void spread (int n)
    {
        auto& here = reach[at (n)];
        if (members[at (component[at (n)])] > 1 || std::ranges::count (next[at (n)], n) > 0) here.recirculates = true;
        here.longest = std::max (here.longest, here.shortest);
        for (const int wire : wires[at (n)])
        {
            const auto e = edgeOf (wire);
            auto& there = reach[at (e.to)];
            if (component[at (e.to)] != component[at (n)]) there.longest = std::max (there.longest, here.longest + e.longest);
            there.recirculates = there.recirculates || here.recirculates;
        }
    }
};
}   // namespace

std::vector<PathDelay> pathDelays (const Flat& flat, const PortUnits& units, const std::vector<int>& node_delays)
{
    std::vector<int> sources;
    bool has_sink = false;
    for (int n = 0; n < flat.nodeCount(); ++n)
    {
        if (PathSearch::reads (flat, n)) sources.push_back (n);
        has_sink = has_sink || PathSearch::acts (flat, n);
    }
    if (sources.empty() || ! has_sink) return {};

    PathSearch search (flat, units, node_delays);
    std::vector<PathDelay> found;
    for (const int source : sources)
        search.addPaths (source, found);
    std::ranges::sort (found, {}, [] (const PathDelay& d) { return std::pair { d.source, d.sink }; });
    return found;
}

}   // namespace tactus::plan
