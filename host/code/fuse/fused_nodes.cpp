// SPDX-License-Identifier: MIT
#include "fused_nodes.hpp"

namespace tactus::host
{

FusedNodes::FusedNodes (const Plan& plan, FusedCode::Classes classes, bool (*has) (const std::string& header))
{
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& type = *plan.flat().nodes[i].type;
        const auto& instance = plan.instances()[i];
        if (! instance.node || ! plan.flat().nodes[i].runs() || type.owner || ! type.origin.empty()) continue;
        if (type.peek && type.inputs.empty()) continue;   // if a wire is at fault, the plan resets the outputs of such a node where they are
        const auto [entry, is_new] = classes.try_emplace (std::string (type.info.id));
        if (is_new) entry->second = classOf (type.info.id);
        const auto& [name, header] = entry->second;
        if (name.empty() || ! has (header)) continue;
        by_address.emplace (instance.node.get(), nodes.size());
        nodes.push_back ({ i, "n" + std::to_string (i), name, header });
        ++uses[header];
    }
}

const PlanNode* FusedNodes::find (const void* node) const
{
    const auto found = by_address.find (node);
    return found != by_address.end() ? &nodes[found->second] : nullptr;
}

std::set<std::string> FusedNodes::headers() const
{
    std::set<std::string> all { FusedCode::parts };
    for (const auto& n : nodes)
        all.insert (n.header);
    return all;
}

}   // namespace tactus::host
