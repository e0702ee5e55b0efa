// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/catalogue.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::plan
{

/// Nodes of one type that run as lanes: the same node in each instance of a subgraph with a `count`. While they do, their state is in packs
/// (LaneForm), and the nodes only hold params and settings. While one of them does not fit into lanes, as with a choice that only single
/// nodes have, all run one by one, with the same bits. Plans with the same nodes in the same order share the group.
class LaneGroup
{
public:
    /// The nodes must be prepared. Call load() before the first tick. Allocates. [main thread]
    LaneGroup (const NodeType&, const LaneForm&, std::vector<std::shared_ptr<void>> nodes);

    LaneGroup (const LaneGroup&) = delete;
    LaneGroup& operator= (const LaneGroup&) = delete;

    const std::vector<std::shared_ptr<void>>& nodes() const noexcept { return all; }
    const LaneForm& form() const noexcept { return lane_form; }
    std::size_t packs() const noexcept { return (all.size() + lane_form.width - 1) / lane_form.width; }

    void load() noexcept;                    ///< takes params and state from the nodes   [tick thread; main thread before anything ticks]
    void unload() noexcept;                  ///< gives the state back to the nodes       [tick thread]
    void refresh (std::size_t i) noexcept;   ///< params of the i-th node have changed    [tick thread]

    /// The inputs and outputs that a plan connects the group to.
    struct Connections
    {
        std::size_t inputs = 0;                         ///< components of all inputs of a node
        const double* const* packed = nullptr;          ///< for each pack and each input component: the value of each lane, side by side
        std::vector<const double* const*> sources {};   ///< by node
        void* outputs = nullptr;                        ///< of the first pack
        std::vector<double> scratch {};                 ///< outputs of one node
    };

    void tick (Connections&) noexcept;   // [tick thread]

private:
    struct Freed
    {
        void operator() (std::byte*) const noexcept;
    };

    void* pack (std::size_t number) const noexcept { return memory.get() + number * lane_form.size; }
    void put (std::size_t i, std::size_t first, std::size_t words, const std::uint64_t* from) noexcept;
    bool allFit() const noexcept;
    void tickOneByOne (Connections&) noexcept;

    const NodeType& type;
    const LaneForm& lane_form;
    const std::vector<std::shared_ptr<void>> all;
    std::unique_ptr<std::byte, Freed> memory;
    bool in_lanes = false;   // [tick thread]
};

/// Runs a group: copies what does not lie side by side, then ticks.
struct LaneStep
{
    /// A value that must lie next to those of other lanes.
    struct Copy
    {
        const double* from;
        double* to;
    };

    LaneGroup* group = nullptr;
    std::vector<const double*> packed {};   ///< as in Connections
    std::vector<Copy> copies {};
    std::vector<double> copied {};   ///< with room for whole packs, aligned like them
    LaneGroup::Connections wiring {};

    static void step (void* self, const double* const*, void*) noexcept
    {
        auto& s = *static_cast<LaneStep*> (self);
        for (const auto& c : s.copies)
            *c.to = *c.from;
        s.group->tick (s.wiring);
    }
};

}   // namespace tactus::plan
