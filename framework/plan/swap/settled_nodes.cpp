// SPDX-License-Identifier: MIT
#include "settled_nodes.hpp"
#include <tactus/plan/flat/grouped.hpp>
#include <tactus/plan/steps/knobs.hpp>

#include <algorithm>

namespace tactus::plan
{

namespace
{
/// True if the node is settled unless something drives it.
bool mayBeSettled (const FlatNode& n)
{
    return n.type->stateless && n.runs() && n.section == 0 && std::ranges::none_of (n.type->inputs, takesHits);
}
}   // namespace

std::vector<bool> settledNodes (const Flat& flat, const Outside& outside)
{
    std::vector<bool> settled (flat.nodes.size());
    for (int i = 0; i < flat.nodeCount(); ++i)
        settled[at (i)] = mayBeSettled (flat.node (i));
    if (std::ranges::none_of (settled, [] (bool s) { return s; })) return settled;

    for (const auto& ports : outside.feeds)
        for (const auto& port : ports)
            settled[at (port.node)] = false;
    for (const auto& w : flat.wires)
        if (w.to.role != Role::input || w.delay > 0 || w.crosses) settled[at (w.to.node)] = false;

    const Grouped<int> next (flat.nodes.size(), [&flat] (auto visit) {
        for (const auto& w : flat.wires)
            if (w.from) visit (w.from->node, w.to.node);
    });
    std::vector<int> moving;   // nodes whose successors have not been visited
    for (int i = 0; i < flat.nodeCount(); ++i)
        if (! settled[at (i)]) moving.push_back (i);
    while (! moving.empty())
    {
        const int node = moving.back();
        moving.pop_back();
        for (const int to : next[at (node)])
            if (settled[at (to)])
            {
                settled[at (to)] = false;
                moving.push_back (to);
            }
    }
    return settled;
}

}   // namespace tactus::plan
