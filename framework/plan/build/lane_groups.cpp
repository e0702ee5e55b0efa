// SPDX-License-Identifier: MIT
#include "lane_groups.hpp"
#include <tactus/plan/flat/make_node.hpp>
#include <tactus/plan/settings/same_settings.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <utility>

namespace tactus::plan
{

namespace
{
class LaneFinder
{
public:
    LaneFinder (const Flat& f, Order& o, const Outside& outside, std::size_t w, double rate)
        : flat (f), order (o), widest (w), rate_hz (rate), driven (f.nodes.size(), false)
    {
        for (const auto& wire : flat.wires)
            if (wire.to.role == Role::param) driven[at (wire.to.node)] = true;
        for (const auto& ports : outside.feeds)
            for (const auto& port : ports)
                if (port.role == Role::param) driven[at (port.node)] = true;
    }

    LaneGroups run()
    {
        collect();
        while (! found.all.empty() && dissolve())
        {
        }
        if (found.all.empty()) return {};
        sort();
        return std::move (found);
    }

private:
    using Group = LaneGroups::Group;

    const Flat& flat;
    Order& order;
    const std::size_t widest;
    const double rate_hz;
    std::vector<bool> driven;   // by node: wires or feeds set its params
    LaneGroups found;

    /// By scope: a number that the instances of a subgraph share.
    std::vector<int> scopesOfInstances() const
    {
        std::vector<int> numbers { 0 };
        std::map<std::pair<int, graph::Id>, int> known;
        for (std::size_t s = 1; s < flat.scopes.size(); ++s)
        {
            const auto& scope = flat.scopes[s];
            numbers.push_back (known.try_emplace ({ numbers[at (scope.scope)], scope.id }, static_cast<int> (s)).first->second);
        }
        return numbers;
    }

    bool canJoin (int node) const
    {
        const auto& n = flat.node (node);
        const bool has_device = n.type->bind || n.type->effort;
        return ! n.type->lanes.empty() && ! has_device && n.runs() && n.section == 0 && ! driven[at (node)];
    }

    /// True if the node fits with the settings and params of the file.
    bool fits (int node) const
    {
        const auto& type = *flat.node (node).type;
        const auto made = makeNode (flat, node);
        if (type.prepare) type.prepare (made.get(), { .rate_hz = rate_hz });
        return type.lanes.fit (made.get());
    }

    /// The narrowest packs that hold all nodes, or the widest ones.
    const LaneForm* formFor (const NodeType& type, std::size_t nodes) const
    {
        const LaneForm* form = nullptr;
        for (std::size_t width = 2; width <= widest && (form == nullptr || form->width < nodes); width *= 2)
            if (const auto* wider = type.lanes.form (width)) form = wider;
        return form;
    }

    void collect()
    {
        const auto scopes = scopesOfInstances();
        std::map<std::pair<int, graph::Id>, std::vector<int>> alike;
        for (int n = 0; n < flat.nodeCount(); ++n)
            if (flat.node (n).identity.scope > 0 && canJoin (n)) alike[{ scopes[at (flat.node (n).identity.scope)], flat.node (n).identity.id }].push_back (n);
        for (auto& [key, nodes] : alike)
        {
            const auto& first = flat.node (nodes.front());
            const auto isLike = [&] (int n) { return flat.node (n).type == first.type && same (flat.node (n).settings, first.settings); };
            const auto* form = nodes.size() > 1 && std::ranges::all_of (nodes, isLike) && fits (nodes.front()) ? formFor (*first.type, nodes.size()) : nullptr;
            if (form != nullptr) found.all.push_back ({ std::move (nodes), form });
        }
        number();
    }

    void number()
    {
        found.of.assign (flat.nodes.size(), -1);
        for (std::size_t g = 0; g < found.all.size(); ++g)
            for (const int n : found.all[g].nodes)
                found.of[at (n)] = static_cast<int> (g);
    }

    //==============================================================================
    // Blocks run as a whole: first the nodes by number, then the sections, then the groups.
    int ofSection (int s) const { return flat.nodeCount() + s; }
    int ofGroup (int g) const { return ofSection (flat.sectionCount()) + g; }
    std::size_t blockCount() const { return at (ofGroup (static_cast<int> (found.all.size()))); }

    int blockOf (int node) const
    {
        if (const int g = found.of[at (node)]; g >= 0) return ofGroup (g);
        int block = node;
        for (int s = flat.node (node).section; s > 0; s = flat.section (s).around)
            block = ofSection (s);
        return block;
    }

    /// Calls `visit (from, to)` for each wire on which its end must wait for its start within a tick.
    template <typename Visit>
    void eachBinding (Visit visit) const
    {
        for (const auto& w : flat.wires)
        {
            if (! w.from || w.delay > 0) continue;
            const auto& start = flat.node (*w.from);
            if (start.section == w.section && start.type->peek != nullptr && ! start.bypass) continue;
            const int from = blockOf (w.from->node), to = blockOf (w.to.node);
            if (from != to || from >= ofGroup (0)) visit (from, to);
        }
    }

    Grouped<int> successors() const
    {
        return { blockCount(), [this] (auto visit) { eachBinding (visit); } };
    }

    /// Removes the groups that are part of a loop. True if there were any.
    bool dissolve()
    {
        const auto next = successors();
        const auto component = components (blockCount(), next);
        std::vector<int> members (blockCount(), 0);
        for (const int c : component)
            ++members[at (c)];
        const auto loops = [&] (const Group& group) {
            const auto block = at (blockOf (group.nodes.front()));
            return members[at (component[block])] > 1 || std::ranges::count (next[block], static_cast<int> (block)) > 0;
        };
        std::vector<Group> rest;
        for (const auto& group : found.all)
            if (! loops (group)) rest.push_back (group);
        if (rest.size() == found.all.size()) return false;
        found.all = std::move (rest);
        number();
        return true;
    }

    /// Brings the groups together. Of the blocks that can run next, the one that came first in the old order runs first.
    void sort()
    {
        const auto next = successors();
        std::vector<int> waiting (blockCount(), 0), place (blockCount(), -1);
        eachBinding ([&] (int, int to) { ++waiting[at (to)]; });
        const auto old = std::exchange (order.front(), {});
        for (std::size_t i = 0; i < old.size(); ++i)
            if (const auto block = at (old[i].section >= 0 ? ofSection (old[i].section) : blockOf (old[i].node)); place[block] < 0)
                place[block] = static_cast<int> (i);

        using Entry = std::pair<int, int>;   // place, block
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> ready;
        const auto offer = [&] (std::size_t block) {
            if (waiting[block] == 0 && place[block] >= 0) ready.emplace (place[block], static_cast<int> (block));
        };
        for (std::size_t b = 0; b < blockCount(); ++b)
            offer (b);
        while (! ready.empty())
        {
            const auto [i, block] = ready.top();
            ready.pop();
            if (block < ofGroup (0))
                order.front().push_back (old[at (i)]);
            else
                for (const int n : found.all[at (block - ofGroup (0))].nodes)
                    order.front().push_back ({ .node = n });
            for (const int b : next[at (block)])
                if (--waiting[at (b)] == 0) offer (at (b));
        }
    }
};
}   // namespace

LaneGroups groupLanes (const Flat& flat, Order& order, const Outside& outside, std::size_t widest, double rate_hz)
{
    return widest < 2 ? LaneGroups {} : LaneFinder { flat, order, outside, widest, rate_hz }.run();
}

}   // namespace tactus::plan
