// SPDX-License-Identifier: MIT
#pragma once

/// The steps of a plan that are not nodes: sums (sum_step.hpp), delayed wires, driven parameters, bypassed nodes. Each has the
/// signature of a node's thunk, so a tick is one loop over records.

#include "sum_step.hpp"
#include <tactus/plan/build/instance.hpp>

#include <tactus/node/catalogue.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace tactus::plan
{

/// Adds hits from outside to what a wire or feed brings to a hit input.
struct Strike
{
    const double* from;
    Pulse* pulse;
    double out = 0.0;

    static void step (void* self, const double* const*, void*) noexcept
    {
        auto& s = *static_cast<Strike*> (self);
        s.out = *s.from;
        if (std::bit_cast<std::uint64_t> (s.pulse->pending) == 0) return;   // compares bits, because it is never -0, and comparing doubles takes two branches
        s.out += s.pulse->pending;
        s.pulse->pending = 0.0;
    }
};

/// One component of a wire with an explicit delay. It is read at the start of a tick and written at its end.
struct DelayLine
{
    const double* from = nullptr;
    Line* line = nullptr;

    static void read (void* self, const double* const*, void*) noexcept
    {
        auto& line = *static_cast<DelayLine*> (self)->line;
        line.out = line.samples[line.now];
    }

    static void write (void* self, const double* const*, void*) noexcept
    {
        auto& [from, line] = *static_cast<DelayLine*> (self);
        line->samples[line->now] = *from;
        if (++line->now == line->samples.size()) line->now = 0;
    }
};

/// A node with wired or fed parameters, which are set before it ticks. If a driving value is not finite, the node gets
/// non-finite inputs instead, so it responds as to any fault.
struct DrivenNode
{
    struct Drive
    {
        double* target;
        const double* stored;              // value of its knob
        const double* replace = nullptr;   // replaces the stored value
        const double* add = nullptr;       // adds to the stored value
        Interval hard {};
    };

    const NodeType* type;
    void* node;
    std::vector<Drive> drives;
    std::vector<const double*> faulted;   // sources that all point to NaN; as many as the node has
    std::vector<std::byte> params;        // the stored Params of the node; empty if the node does not ask for them

    void tick (const double* const* sources, void* outputs) noexcept
    {
        if (params.empty()) return type->tick (node, sources, outputs);
        const auto* own = static_cast<const std::byte*> (type->paramsOf (node));
        std::memcpy (params.data(), own, params.size());
        for (const auto& drive : drives)
            std::memcpy (params.data() + (reinterpret_cast<const std::byte*> (drive.target) - own), drive.stored, sizeof (double));
        type->tickStored (node, params.data(), sources, outputs);
    }

    static void step (void* self, const double* const* sources, void* outputs) noexcept
    {
        auto& d = *static_cast<DrivenNode*> (self);
        bool moved = false, fault = false;
        for (const auto& drive : d.drives)
        {
            const double wanted = *(drive.replace ? drive.replace : drive.stored) + (drive.add ? *drive.add : 0.0);
            const double value = drive.hard.clamp (wanted);
            if (! isFinite (value))
                fault = true;
            else if (value != *drive.target)
            {
                *drive.target = value;
                moved = true;
            }
        }
        if (moved && d.type->update) d.type->update (d.node);
        d.tick (fault ? d.faulted.data() : sources, outputs);
        if (fault && d.faulted.empty()) d.type->initialiseOutputs (outputs);
    }
};

/// Replaces a bypassed node: passes its inputs on to its outputs. Wired entries of an array port add up. Unwired entries are
/// left out, because their default (1 for a product) is not an input.
struct Bypass
{
    struct Copy
    {
        double* to;
        std::vector<std::size_t> slots;   // indices of the sources to add up
    };

    std::vector<Copy> copies;

    static void step (void* self, const double* const* sources, void*) noexcept
    {
        for (const auto& c : static_cast<const Bypass*> (self)->copies)
        {
            double values[list_capacity];
            for (std::size_t i = 0; i < c.slots.size(); ++i)
                values[i] = *sources[c.slots[i]];
            *c.to = c.slots.size() == 1 ? values[0] : sum (values, static_cast<int> (c.slots.size()));
        }
    }
};

}   // namespace tactus::plan
