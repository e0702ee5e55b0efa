// SPDX-License-Identifier: MIT
#include "node_memory.hpp"
#include "counted_memory.hpp"

#include <tactus/plan/flat/make_node.hpp>

#include <memory>
#include <vector>

namespace tactus::host
{

NodeMemory memoryOf (const PlanNames& wiring)
{
    // Containers of exported code can take slightly more than those of the C++ library, for instance for their own book-keeping.
    constexpr std::size_t spare_per_node = 64, spare_part = 8, if_unknown = 1 << 20;
    const auto& plan = wiring.plan;
    std::vector<std::shared_ptr<void>> nodes;
    nodes.reserve (wiring.nodes.size());
    CountedMemory count;
    for (const auto& n : wiring.nodes)
    {
        count.expectNode();
        nodes.push_back (plan::makeNode (plan.flat(), static_cast<int> (n.instance)));
        const auto& type = wiring.type (n);
        const Setup setup { .rate_hz = plan.rateHz() * plan.flat().speed (wiring.flat (n).section) };
        if (type.prepare) type.prepare (nodes.back().get(), setup);
        if (type.update) type.update (nodes.back().get());
    }
    // A node of this program is made together with the two counters of a shared pointer.
    std::size_t counters = 0;
    for (const auto& n : wiring.nodes)
        if (wiring.type (n).origin.empty()) counters += sizeof (void*) + 2 * sizeof (int);
    if (! CountedMemory::counts) return { .nodes = 0, .prepared = if_unknown };
    const auto most = count.bytes();
    return { .nodes = count.nodeBytes() - counters, .prepared = (most + most / spare_part + spare_per_node * (1 + nodes.size()) + 15) / 16 * 16 };
}

}   // namespace tactus::host
