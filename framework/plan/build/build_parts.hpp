// SPDX-License-Identifier: MIT
#pragma once

/// The parts of a plan under construction.

#include <tactus/plan/plan.hpp>
#include <tactus/plan/steps/ops.hpp>
#include <tactus/plan/swap/owned_records.hpp>

#include <cstdint>
#include <vector>

namespace tactus::plan
{

/// Something that drives one component of an input or parameter.
struct Driver
{
    enum class Kind
    {
        replace,
        add,
        feed   ///< takes precedence over wires
    };

    Kind kind;
    Sum::Term term;
};

/// The records of a section, in order: delayed wires and peeking nodes deliver their outputs, nodes run, delayed wires read their
/// inputs.
struct SectionSteps
{
    OwnedRecords peeks, body, writes;
};

/// The nodes in running order, including those of inner sections.
std::vector<int> inOrder (const Flat&, const Order&);

/// Reserves room for the outputs of all nodes, side by side in this order. Returns the offset of each node's outputs; `size` is the
/// size of all of them.
std::vector<std::size_t> outputOffsets (const Flat&, const std::vector<int>& running, std::size_t& size);

/// Keeps the flat graph for the next plan, without the parts that only messages need. Leaves its messages.
void keepFlat (Flat&, PlanParts&);

/// Drops the edits of params that must keep their values; `kept` are their names.
void dropKept (PlanParts&, const std::vector<std::string>& kept);

/// By node: the ticks from its inputs to its outputs.
std::vector<int> nodeDelays (const Flat&, const std::vector<Instance>&);

}   // namespace tactus::plan
