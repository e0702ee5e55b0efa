// SPDX-License-Identifier: MIT
#pragma once

/// The steps of a plan that are not nodes: sums, delayed wires, driven parameters, bypassed nodes. Each has the shape
/// of a node's thunk, so that a tick is one loop over records.

#include "instance.hpp"
#include "sum.hpp"

#include <framework/catalogue.hpp>

#include <cstddef>
#include <vector>

namespace tactus::plan
{

/// Where several wires, or one with a gain, come together.
struct Sum
{
    struct Term
    {
        const double* from;
        double gain;
    };

    std::vector<Term> terms;
    std::vector<double> scratch;   // as many as terms
    double out = 0.0;

    static void step (void* self, const double* const*, void*) noexcept
    {
        auto& s = *static_cast<Sum*> (self);
        for (std::size_t i = 0; i < s.terms.size(); ++i)
            s.scratch[i] = s.terms[i].gain * *s.terms[i].from;
        s.out = sum (s.scratch.data(), static_cast<int> (s.terms.size()));
    }
};

/// What comes to an input for hits: by wire or feed, and from outside.
struct Strike
{
    const double* from;
    Pulse* pulse;
    double out = 0.0;

    static void step (void* self, const double* const*, void*) noexcept
    {
        auto& s = *static_cast<Strike*> (self);
        s.out = *s.from;
        if (s.pulse->pending == 0.0) return;
        s.out += s.pulse->pending;
        s.pulse->pending = 0.0;
    }
};

/// One component of a wire with an explicit delay. Reading stands at the start of a tick, writing at its end.
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

/// A node some of whose parameters are wired or fed: they are set before it ticks. If one cannot be, because what
/// drives it is not finite, the node gets non-finite inputs instead, and so does what it does on any fault.
struct DrivenNode
{
    struct Drive
    {
        double* target;
        const double* stored;              // its knob
        const double* replace = nullptr;   // instead of the stored value
        const double* add = nullptr;       // to it
        Interval hard {};
    };

    const NodeType* type;
    void* node;
    std::vector<Drive> drives;
    std::vector<const double*> faulted;   // as many sources as the node has, all nan

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
        d.type->tick (d.node, fault ? d.faulted.data() : sources, outputs);
        if (fault && d.faulted.empty()) d.type->initialiseOutputs (outputs);
    }
};

/// Stands in for a bypassed node: passes inputs on to outputs. Of an array port, what is wired adds up; the default of
/// an entry that is not (1 for a product) is nothing that came in.
struct Bypass
{
    struct Copy
    {
        double* to;
        std::vector<std::size_t> slots;   // among the sources; their sum
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
