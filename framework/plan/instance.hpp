// SPDX-License-Identifier: MIT
#pragma once

/// What lives on from plan to plan: nodes, their parameters, and what is under way on delayed wires.

#include "knobs.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::plan
{

/// A node as it stands in a plan, beside its entry in the flat graph.
struct Instance
{
    std::uint64_t serial = 0;       ///< of the node; a new one if it was made anew
    std::shared_ptr<void> node;     ///< none for a bypassed subgraph
    std::shared_ptr<Knobs> knobs;   ///< none without params
    std::vector<bool> driven;       ///< by knob: a wire or feed has the last word; empty if none is
    int delay = 1;                  ///< ticks from input to output, if it peeks
    bool dirty = true;              ///< is not what it was in the plan before, or hears from something that is not

    /// Its place in the node. Not for a knob of a choice.
    double* param (std::size_t knob) const noexcept;
    void write (std::size_t knob, double value) const noexcept;   ///< also of a choice   [tick thread]
    bool isDriven (std::size_t knob) const noexcept { return ! driven.empty() && driven[knob]; }
};

/// What is under way on one component of a delayed wire.
struct Line
{
    std::uint64_t serial = 0;
    std::vector<double> samples;
    std::size_t now = 0;

    /// Goes on from a line of another length: the newest samples stay, and beyond the oldest is held. [tick thread]
    void adopt (const Line& old) noexcept
    {
        const auto had = old.samples.size(), size = samples.size();
        for (std::size_t age = 1; age <= size; ++age)
            samples[size - age] = old.samples[(old.now + had - std::min (age, had)) % had];
        now = 0;
    }
};

/// Unique in a process, as ids are. [any thread]
std::uint64_t newSerial() noexcept;

}   // namespace tactus::plan
