// SPDX-License-Identifier: MIT
#pragma once

#include "heirs.hpp"
#include "plan.hpp"

namespace tactus::plan
{

/// How a plan being built follows the one before: which nodes go on as they are, what others inherit, and which roles
/// are not touched. Reads of the plan before only what does not move while it ticks. [main thread]
class Succession
{
public:
    /// Nodes that are not in the plan before have the knobs that they had in the withdrawn one, if there is one.
    Succession (const Flat& now, const Plan* before, const Plan* withdrawn, double rate_hz);

    /// The instance before that a node is the heir of; null if there is none, or it was of another type.
    const Instance* heritageOf (std::size_t node) const noexcept;

    /// True if the node stays the same in every way, but for its wires and params.
    bool goesOn (std::size_t node) const noexcept { return going[node]; }

    /// The knobs of a node that has params: those it had, or new ones as the file has them. Notes in `takeover` what
    /// the file has otherwise than before.
    std::shared_ptr<Knobs> knobsOf (std::size_t node, Takeover&) const;

    /// Notes what a node made anew takes over.
    void succeed (std::size_t node, Takeover&) const;

    /// What is under way on a component of a delayed wire.
    std::shared_ptr<Line> lineOf (int wire, int component, int ticks, Takeover&) const;

    /// What is under way on a component of a wire, or of a feed that is counted after them, where it enters or leaves a section.
    std::shared_ptr<Passage> passageOf (int wire, int component, int step, Way, Takeover&) const;

    /// Once all else of the plan is in place, the flat graph too: its nodes that are changed or hear from what is changed, and with them
    /// the roles; and the params that are not driven any more.
    void compare (Plan&) const;

private:
    /// A node of another plan; of none, if the plan is null.
    struct Forebear
    {
        const Plan* plan = nullptr;
        std::size_t node = 0;
    };

    Forebear knobsBefore (std::size_t node) const noexcept;
    std::uint32_t turnsBefore (const Knobs&, std::size_t knob, double value) const noexcept;
    bool isSame (std::size_t node) const;
    std::vector<bool> changed (const Plan&) const;
    static void spread (const std::vector<bool>& dirty, Plan&);

    const Flat& flat;
    const Plan *before, *withdrawn;
    double rate_hz;
    Heirs heirs, heirs_of_withdrawn;
    std::vector<bool> going;
};

}   // namespace tactus::plan
