// SPDX-License-Identifier: MIT
#include "missing_parts.hpp"

#include <framework/in_quotes.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace tactus
{

Messages missingParts (const Plan& plan)
{
    Messages messages;
    std::set<std::pair<std::string, std::string>> told;
    for (std::size_t i = 0; i < plan.instances.size(); ++i)
    {
        const auto& node = plan.flat.nodes[i];
        if (! node.type->missing || ! node.runs()) continue;
        const auto role = std::ranges::find (plan.roles, node.role, &Plan::RoleUse::name);
        auto what = node.type->missing (plan.instances[i].node.get(), role->state->layout);
        if (what.empty() || ! told.emplace (node.role, what).second) continue;

        const auto outermost = node.path.substr (0, node.path.find_first_of ("/["));
        const bool acts = node.type->effort != nullptr;
        messages.push_back ({ .severity = Message::Severity::warning,
                              .id = "device/missing_part",
                              .where = "/nodes/" + outermost,
                              .text = inQuotes (node.path) + " (" + std::string (node.type->info.id) + "): the device of the role " + inQuotes (node.role) + " has " + what,
                              .remedy = std::string (acts ? "until then it acts on nothing" : "until then it reads 0") + ": set the node to what there is, or give the role another device" });
    }
    return messages;
}

}   // namespace tactus
