// SPDX-License-Identifier: MIT
#include "build_parts.hpp"
#include <tactus/plan/find_param.hpp>

#include <algorithm>
#include <utility>

namespace tactus::plan
{

std::vector<int> inOrder (const Flat& flat, const Order& order)
{
    std::vector<int> all;
    all.reserve (flat.nodes.size());
    const auto add = [&] (const auto& self, int section) -> void {
        for (const auto& step : order[at (section)])
            if (step.section >= 0)
                self (self, step.section);
            else
                all.push_back (step.node);
    };
    if (! order.empty()) add (add, 0);
    return all;
}

std::vector<std::size_t> outputOffsets (const Flat& flat, const std::vector<int>& running, std::size_t& size)
{
    std::vector<std::size_t> offsets (flat.nodes.size());
    size = 0;
    for (const int i : running)
    {
        const auto& type = *flat.node (i).type;
        size = (size + type.outputs_align - 1) / type.outputs_align * type.outputs_align;
        offsets[at (i)] = size;
        size += type.outputs_size;
    }
    return offsets;
}

void keepFlat (Flat& flat, PlanParts& parts)
{
    auto messages = std::move (flat.messages);
    parts.flat = std::move (flat);
    flat.messages = std::move (messages);   // NOLINT(bugprone-use-after-move): gives a moved-from member a value
    parts.flat.assignments = {};
    parts.flat.places = {};
    for (std::size_t i = 0; i < parts.flat.nodes.size(); ++i)
        parts.flat.nodes[i].origin = {};
    for (std::size_t i = 0; i < parts.flat.wires.size(); ++i)
    {
        auto& w = parts.flat.wires[i];
        w.origin = {};
        w.written = {};
    }
    for (auto& s : parts.flat.sections)
        s.origin = {};
}

void dropKept (PlanParts& parts, const std::vector<std::string>& kept)
{
    if (kept.empty()) return;
    std::erase_if (parts.takeover.changes,
                   [&] (const Takeover::Change& change) { return std::ranges::count (kept, nameOf (parts.flat, change.instance, change.knob)) > 0; });
}

std::vector<int> nodeDelays (const Flat& flat, const std::vector<Instance>& instances)
{
    std::vector<int> delays;
    delays.reserve (flat.nodes.size());
    for (int i = 0; i < flat.nodeCount(); ++i)
    {
        const auto& n = flat.node (i);
        const bool source = n.type->bind && ! n.type->effort;
        const bool waits = n.type->peek && ! n.bypass && ! source;
        delays.push_back (waits ? instances[at (i)].delay : 0);
    }
    return delays;
}

}   // namespace tactus::plan
