// SPDX-License-Identifier: MIT
#include "inside.hpp"
#include "instances.hpp"

#include <algorithm>

namespace tactus::graph
{

Inside insideOf (const Graph& owner, const Node& node)
{
    if (node.type.starts_with ("graph:"))
    {
        const auto* patch = owner.find (std::string_view (node.type).substr (6));
        return patch == nullptr ? Inside {} : Inside { &owner, patch };
    }
    const auto file = node.type.starts_with ("file:") ? owner.files.find (node.type.substr (5)) : owner.files.end();
    return file == owner.files.end() ? Inside {} : Inside { file->second.get(), &file->second->root };
}

Endpoint innermost (const Graph& g, const Patch& p, Endpoint e, std::vector<std::pair<std::string, Endpoint>> Expose::*list)
{
    constexpr int deepest = 32;   // a broken graph may contain itself
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

}   // namespace tactus::graph
