// SPDX-License-Identifier: MIT
#include "object_size.hpp"

#include <tactus/run/generated/exported_graph.hpp>
#include <tactus/run/generated/exported_memory.hpp>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

namespace
{
/// The size of a member of the state: see PlanNames::kept.
std::size_t sizeOf (const std::string& type)
{
    const std::string line = "tactus::exported::DelayLine<";
    if (type.starts_with (line)) return sizeof (exported::DelayLine<1>) + sizeof (double) * (std::strtoul (type.c_str() + line.size(), nullptr, 10) - 1);
    if (type == "tactus::exported::Gathered") return sizeof (exported::Gathered);
    return type == "tactus::exported::Line" ? sizeof (exported::Line) : sizeof (double);
}

std::size_t stateSize (const PlanNames& wiring)
{
    std::size_t all = 0;
    for (const auto& [type, name] : wiring.kept)
        all += sizeOf (type);
    for (const auto& n : wiring.nodes)
        if (n.is_inner && n.is_read) all += wiring.type (n).outputs_size;
    return all;
}

/// A layout has its names in itself, because it takes nothing from a heap. A role has its own layout and that in its state.
constexpr std::size_t role_size = sizeof (exported::Role) + 2 * 3 * (sizeof (exported::NameList) - sizeof (std::vector<std::string>));
}   // namespace

ObjectSize objectSize (const Exported& e)
{
    constexpr std::size_t block = 4 * sizeof (void*), ticks = sizeof (std::uint64_t), alignment = alignof (std::max_align_t);
    std::set<std::size_t> with_parameters;
    for (const auto& p : e.parameters)
        with_parameters.insert (p.node);
    ObjectSize size;
    size.nodes = e.memory.nodes;
    size.prepared = e.memory.prepared + block;
    size.roles = role_size * e.roles.size();
    if (! e.parameters.empty())
        size.parameters = sizeof (exported::Parameters<1, 1>) + sizeof (exported::Parameter) * (e.parameters.size() - 1)
                          + sizeof (exported::NodeParameters) * (with_parameters.size() - 1);
    size.others = stateSize (e.wiring) + ticks + (e.roles.empty() ? 0 : sizeof (double)) + sizeof (exported::Hits) * e.hits.size();
    size.others += (alignment - size.all() % alignment) % alignment;
    size.inputs = sizeof (Reading) * e.roles.size() + sizeof (double) * e.wiring.feed_names.size();
    size.outputs = sizeof (Effort) * e.roles.size();
    for (const auto& tap : e.wiring.plan.taps())
        size.outputs += sizeof (double) * static_cast<std::size_t> (tap.samples == nullptr ? 1 : tap.per_tick);
    return size;
}

}   // namespace tactus::host
