// SPDX-License-Identifier: MIT
#include "graph.hpp"

#include <algorithm>
#include <atomic>

namespace tactus::graph
{

Id newId() noexcept
{
    static std::atomic<Id> last { 0 };
    return ++last;
}

const Node* Patch::find (std::string_view wanted) const noexcept
{
    const auto at = std::ranges::find (nodes, wanted, &Node::name);
    return at == nodes.end() ? nullptr : &*at;
}

const Patch* Graph::find (std::string_view subgraph) const noexcept
{
    const auto at = std::ranges::find (graphs, subgraph, &std::pair<std::string, Patch>::first);
    return at == graphs.end() ? nullptr : &at->second;
}

const Json* Graph::device (std::string_view role) const noexcept
{
    const auto at = std::ranges::find (devices, role, &std::pair<std::string, Json>::first);
    return at == devices.end() ? nullptr : &at->second;
}

}   // namespace tactus::graph
