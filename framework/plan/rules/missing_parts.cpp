// SPDX-License-Identifier: MIT
#include "missing_parts.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace tactus
{

Messages missingParts (const Plan& plan)
{
    Messages messages;
    std::set<std::pair<std::string, std::string>> reported;
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
    {
        const auto& node = plan.flat().nodes[i];
        if (! node.type->missing || ! node.runs()) continue;
        auto what = node.type->missing (plan.instances()[i].node.get(), plan.findRole (node.role)->state->layout);
        if (what.empty() || ! reported.emplace (node.role, what).second) continue;

        const auto outermost = node.path.substr (0, node.path.find_first_of ("/["));
        const bool acts = node.type->effort != nullptr;
        messages.push_back (
            Message::warning ("device/missing_part", "/nodes/" + outermost,
                              quote (node.path) + " (" + std::string (node.type->info.id) + "): the device of the role " + quote (node.role) + " has " + what,
                              std::string (acts ? "the node has no effect until you " : "the node reads 0 until you ")
                                  + "set it to a part that the device has, or give the role another device"));
    }
    return messages;
}

}   // namespace tactus
