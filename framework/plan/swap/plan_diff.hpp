// SPDX-License-Identifier: MIT
#pragma once

#include "matching.hpp"
#include <tactus/plan/plan.hpp>

namespace tactus::plan
{

/// Compares a plan under construction with the previous plan: which nodes continue unchanged, what the other nodes inherit, and
/// which roles are untouched. Reads only those parts of the previous plan that do not change while it ticks. [main thread]
class PlanDiff
{
public:
    /// A node that is not in the previous plan keeps the knobs it had in the withdrawn plan. Both plans may be null.
    PlanDiff (const Flat& now, const PlanParts* before, const PlanParts* withdrawn, double rate_hz);

    /// The matching instance of the previous plan; null if there is none, or if its type differs.
    const Instance* predecessorOf (std::size_t node) const noexcept;

    /// For a node in a section that does not run on every tick: the predecessor, whose outputs are kept until the node first runs.
    /// Null for other nodes, and if the outputs of the predecessor do not fit.
    const Instance* heldFrom (std::size_t node) const;

    /// True if nothing about the node has changed except its wires and params, so both plans share it.
    bool continues (std::size_t node) const noexcept { return continuing[node]; }

    /// The knobs of a node: its previous ones, or new ones with the stored values. Adds edited values to `takeover`. Null for a
    /// node with neither params nor hit inputs. New ones take a place on the board.
    std::shared_ptr<Knobs> knobsOf (std::size_t node, const std::shared_ptr<KnobBoard>&, Takeover&) const;

    /// Records in `takeover` what a new node takes over from its predecessor.
    void noteSuccessor (std::size_t node, Takeover&) const;

    /// The line of a component of a delayed wire: its previous one, or a new one.
    std::shared_ptr<Line> lineOf (int wire, int component, int ticks, Takeover&) const;

    /// The rate converter of a component of a wire or feed where it enters or leaves a section: its previous one, or a new one.
    /// Feeds are numbered after the wires.
    std::shared_ptr<RateConverter> rateConverterOf (int wire, int component, int step, Conversion, Takeover&) const;

    /// The last step of building, when everything else is in place: marks the nodes that changed or that have a changed node
    /// upstream, the untouched roles, and the params that are no longer driven.
    void compare (PlanParts&) const;

private:
    /// A node of another plan; if `plan` is null, there is no such node.
    struct Predecessor
    {
        const PlanParts* plan = nullptr;
        std::size_t node = 0;
    };

    Predecessor knobsBefore (std::size_t node) const noexcept;
    Predecessor rebuiltFrom (std::size_t node) const noexcept;   ///< the node of the previous plan with another build of the same type
    std::uint32_t turnsBefore (const Knobs&, std::size_t knob, double value) const noexcept;
    bool isSame (std::size_t node) const;
    std::vector<bool> changed (const PlanParts&) const;
    static void spread (std::vector<bool>& dirty, const PlanParts&);

    const Flat& flat;
    const PlanParts *before, *withdrawn;
    double rate_hz;
    Matching matching, matching_withdrawn;   // with the previous plan, and with the withdrawn one
    std::vector<bool> continuing;            // by node
};

}   // namespace tactus::plan
