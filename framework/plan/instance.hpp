// SPDX-License-Identifier: MIT
#pragma once

/// What lives on from plan to plan: nodes, their parameters, and what is under way on wires that are delayed or lead
/// from one rate to another.

#include "knobs.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::plan
{

/// A node as it stands in a plan, beside its entry in the flat graph.
struct Instance
{
    std::uint64_t serial = 0;                 ///< of the node; a new one if it was made anew
    std::shared_ptr<void> node;               ///< none for a bypassed subgraph
    std::shared_ptr<Knobs> knobs;             ///< none without params and inputs for hits
    bool is_struck = false;                   ///< runs, and hears its pulses
    std::vector<bool> driven;                 ///< by knob: a wire or feed has the last word; empty if none is
    int delay = 1;                            ///< ticks from input to output, if it peeks
    void* outputs = nullptr;                  ///< in the plan's storage, as its type lays them out
    const double* const* sources = nullptr;   ///< of its inputs, in the plan's storage
    bool dirty = true;                        ///< is not what it was in the plan before, or hears from something that is not

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
    double out = 0.0;   ///< what arrives on this tick

    /// Goes on from a line of another length: the newest samples stay, and beyond the oldest is held. [tick thread]
    void adopt (const Line& old) noexcept
    {
        const auto had = old.samples.size(), size = samples.size();
        for (std::size_t age = 1; age <= size; ++age)
            samples[size - age] = old.samples[(old.now + had - std::min (age, had)) % had];
        now = 0;
        out = old.out;
    }
};

/// How one component of a wire enters or leaves a section.
struct Way
{
    enum class Kind
    {
        latch,    ///< as it stands when the section runs
        gather,   ///< all there was since it last arrived, added up
        line,     ///< in a straight line from the value before to the newest
        pulse     ///< on the first tick, then 0
    };

    Kind kind = Kind::latch;
    int factor = 1;   ///< of the section
    bool enters = true;

    bool operator== (const Way&) const = default;
};

/// What is under way there.
struct Passage
{
    std::uint64_t serial = 0;
    double out = 0.0;                    ///< what arrives
    double gathered = 0.0;               ///< and has not arrived yet
    double before = 0.0, newest = 0.0;   ///< the ends of the line
    bool begun = false;                  ///< there is a newest

    /// Goes on where another way stood. The serial is not touched, since the next plan is made of it meanwhile. [tick thread]
    void adopt (const Passage& old) noexcept
    {
        out = old.out;
        gathered = old.gathered;
        before = old.before;
        newest = old.newest;
        begun = old.begun;
    }
};

/// Unique in a process, as ids are. [any thread]
std::uint64_t newSerial() noexcept;

}   // namespace tactus::plan
