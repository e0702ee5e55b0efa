// SPDX-License-Identifier: MIT
#include "lane_wiring.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>

namespace tactus::plan
{

namespace
{
using SharedGroup = std::shared_ptr<LaneGroup>;

/// The group of the previous plan that has the same nodes in the same order; null if there is none.
SharedGroup findSame (const LaneForm& form, const std::vector<std::shared_ptr<void>>& nodes, std::span<const SharedGroup> before)
{
    const auto isSame = [&] (const SharedGroup& group) { return &group->form() == &form && group->nodes() == nodes; };
    const auto old = std::ranges::find_if (before, isSame);
    return old == before.end() ? nullptr : *old;
}
}   // namespace

void makeLaneGroups (const LaneGroups& lanes, const Flat& flat, const PlanParts* before, PlanParts& parts)
{
    const auto old = before ? std::span (before->lanes) : std::span<const SharedGroup> {};
    for (const auto& [numbers, form] : lanes.all)
    {
        std::vector<std::shared_ptr<void>> nodes;
        for (const int n : numbers)
            nodes.push_back (parts.instances[at (n)].node);
        auto group = findSame (*form, nodes, old);
        if (! group)
        {
            group = std::make_shared<LaneGroup> (*flat.node (numbers.front()).type, *form, std::move (nodes));
            if (before)
                parts.takeover.begun.push_back (group.get());
            else
                group->load();   // nothing else ticks its nodes
        }
        for (std::size_t k = 0; k < numbers.size(); ++k)
        {
            auto& instance = parts.instances[at (numbers[k])];
            instance.lanes = group.get();
            instance.lane = static_cast<std::uint32_t> (k);
        }
        parts.lanes.push_back (std::move (group));
    }
    for (const auto& group : old)
        if (std::ranges::count (parts.lanes, group) == 0) parts.takeover.ended.push_back (group.get());
}

namespace
{
/// The sources of one input component for the lanes of one pack.
class Lanes
{
public:
    Lanes (const Storage& s, std::size_t w) : storage (s), width (w) {}

    std::vector<std::size_t> slots;   // of the instances

    /// True if the values lie side by side where a pack can load them: in the outputs of another group, for all lanes of a pack.
    bool areSideBySide() const
    {
        if (slots.size() != width) return false;
        const auto* first = storage.sources[slots.front()];
        const auto* bytes = reinterpret_cast<const std::byte*> (first);
        if (bytes < storage.outputs.bytes || bytes >= storage.outputs.bytes + storage.outputs.size) return false;
        if (reinterpret_cast<std::uintptr_t> (first) % (width * sizeof (double)) != 0) return false;
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (storage.sources[slots[i]] != first + i) return false;
        return true;
    }

    bool isDefault (std::size_t i) const { return storage.sources[slots[i]] == &storage.defaults[slots[i]]; }

private:
    const Storage& storage;
    std::size_t width;
};
}   // namespace

void connect (LaneStep& step, const LaneGroups::Group& group, const Flat& flat, const Slots& slots, const Storage& storage, void* outputs)
{
    constexpr std::size_t alignment = 64 / sizeof (double);
    const auto& form = *group.form;
    const auto& node = flat.node (group.nodes.front());
    const auto inputs = Slots::inputsOf (node), count = group.nodes.size(), packs = (count + form.width - 1) / form.width;

    step.copied.assign (packs * inputs * form.width + alignment, 0.0);
    auto* room = step.copied.data();
    room += (alignment - reinterpret_cast<std::uintptr_t> (room) / sizeof (double) % alignment) % alignment;
    for (std::size_t p = 0; p < packs; ++p)
        for (std::size_t c = 0; c < inputs; ++c)
        {
            Lanes lanes { storage, form.width };
            for (auto i = p * form.width; i < std::min (count, (p + 1) * form.width); ++i)
                lanes.slots.push_back (slots.firstInput (group.nodes[i]) + c);
            if (lanes.areSideBySide())
            {
                step.packed.push_back (storage.sources[lanes.slots.front()]);
                continue;
            }
            step.packed.push_back (room);
            std::fill_n (room, form.width, storage.defaults[lanes.slots.front()]);   // also of the lanes without an instance
            for (std::size_t i = 0; i < lanes.slots.size(); ++i)
                if (! lanes.isDefault (i)) step.copies.push_back ({ storage.sources[lanes.slots[i]], room + i });
            room += form.width;
        }

    step.wiring.inputs = inputs;
    step.wiring.packed = step.packed.data();
    step.wiring.outputs = outputs;
    step.wiring.scratch.resize (node.type->outputs_size / sizeof (double));
    for (const int n : group.nodes)
        step.wiring.sources.push_back (storage.sources.data() + slots.firstInput (n));
}

}   // namespace tactus::plan
