// SPDX-License-Identifier: MIT
#include "graph_index.hpp"

#include <algorithm>

namespace tactus::plan
{

void GraphIndex::follow (const graph::Patch& patch)
{
    while (links.size() < patch.nodes.size())
    {
        names.add (patch.nodes[links.size()].name);
        links.emplace_back();
    }
    while (ends.size() < patch.wires.size())
    {
        const auto& wire = patch.wires[ends.size()];
        const int number = static_cast<int> (ends.size());
        const auto [from, to, id] = ends.emplace_back (Ends { node (wire.from.node), node (wire.to.node), wire.id });
        if (from != none) links[tactus::at (from)].out.push_back (number);
        if (to != none) links[tactus::at (to)].in.push_back (number);
    }
}

void GraphIndex::remove (graph::Id wire)
{
    const auto known = std::ranges::find (ends, wire, &Ends::id);
    if (known == ends.end()) return forget();
    const int number = static_cast<int> (known - ends.begin());
    ends.erase (known);
    for (auto& [in, out] : links)
        for (auto* list : { &in, &out })
        {
            std::erase (*list, number);
            for (int& w : *list)
                w -= w > number ? 1 : 0;
        }
}

int GraphIndex::node (std::string_view path) const noexcept
{
    const auto number = names.find (path.substr (0, path.find_first_of ("[/")));
    return number == Names::none ? none : static_cast<int> (number);
}

}   // namespace tactus::plan
