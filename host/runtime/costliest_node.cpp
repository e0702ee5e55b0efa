// SPDX-License-Identifier: GPL-3.0-or-later
#include "costliest_node.hpp"

#include <framework/number_text.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

namespace tactus::host
{

std::string costliestNode (Plan& plan)
{
    using Clock = std::chrono::steady_clock;
    constexpr int rounds = 31;
    constexpr auto longest = std::chrono::milliseconds (500);

    std::vector<double> costs (plan.records.size(), std::numeric_limits<double>::infinity());   // the least counts: the rest is other programs
    const auto begin = Clock::now();
    for (int i = 0; i < rounds && (i == 0 || Clock::now() - begin < longest); ++i)
        for (std::size_t r = 0; r < costs.size(); ++r)
        {
            const auto& record = plan.records[r];
            const auto before = Clock::now();
            record.step (record.self, record.sources, record.outputs);
            costs[r] = std::min (costs[r], std::chrono::duration<double> (Clock::now() - before).count());
        }

    const auto most = std::ranges::max_element (costs);
    if (most == costs.end()) return "there is no node";
    const double share = 100.0 * *most / std::accumulate (costs.begin(), costs.end(), 0.0);
    std::string name = "a node whose parameters are driven";
    for (std::size_t i = 0; i < plan.instances.size(); ++i)
        if (plan.instances[i].node && plan.instances[i].node.get() == plan.records[static_cast<std::size_t> (most - costs.begin())].self)
            name = "'" + plan.flat.nodes[i].path + "' (" + std::string (plan.flat.nodes[i].type->info.id) + ")";
    return name + " takes " + numberText (std::round (share)) + " % of a tick";
}

}   // namespace tactus::host
