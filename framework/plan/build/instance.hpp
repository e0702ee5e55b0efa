// SPDX-License-Identifier: MIT
#pragma once

/// The things that survive from plan to plan: nodes, their parameters, and the values in transit on wires that are delayed or change rate.

#include <tactus/plan/steps/knobs.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::plan
{

/// A node in a plan; its entry in the flat graph has the same number.
struct Instance
{
    std::uint64_t serial = 0;                 ///< serial number of the node; a replacement gets a new one
    std::shared_ptr<void> node;               ///< null for a bypassed subgraph
    std::shared_ptr<Knobs> knobs;             ///< null if the node has neither params nor hit inputs
    bool is_struck = false;                   ///< the node runs and accepts hits from outside
    std::vector<bool> driven;                 ///< by knob: a wire or feed sets the value; empty if none is driven
    int delay = 1;                            ///< ticks from input to output, if the node peeks
    void* outputs = nullptr;                  ///< in the plan's storage, as the node's type lays them out
    const double* const* sources = nullptr;   ///< by input component, in the plan's storage

    /// The double of the outputs at this offset in bytes, as PortSheet::offset counts.
    double* output (std::size_t offset) const noexcept { return reinterpret_cast<double*> (static_cast<std::byte*> (outputs) + offset); }

    /// Address of a parameter in the node. Not for a choice, which is an int.
    double* param (std::size_t knob) const noexcept;
    void write (std::size_t knob, double value) const noexcept;   ///< also works for a choice   [tick thread]
    bool isDriven (std::size_t knob) const noexcept { return ! driven.empty() && driven[knob]; }
};

/// The values in transit on one component of a delayed wire.
struct Line
{
    std::uint64_t serial = 0;
    std::vector<double> samples;
    std::size_t now = 0;
    double out = 0.0;   ///< the value that arrives on this tick

    /// Continues a line of a different length. Keeps the newest samples; if this line is longer, repeats the oldest. [tick thread]
    void adopt (const Line& old) noexcept
    {
        const auto had = old.samples.size(), size = samples.size();
        for (std::size_t age = 1; age <= size; ++age)
            samples[size - age] = old.samples[(old.now + had - std::min (age, had)) % had];
        now = 0;
        out = old.out;
    }
};

/// The conversion of one component of a wire that enters or leaves a section.
struct Conversion
{
    enum class Kind
    {
        latch,    ///< the value at the time the section runs
        gather,   ///< the sum of all values since the last delivery
        line,     ///< a straight line from the previous value to the newest
        pulse     ///< the value on the first tick, then 0
    };

    Kind kind = Kind::latch;
    int factor = 1;   ///< factor of the section
    bool enters = true;

    bool operator== (const Conversion&) const = default;
};

/// The state of one rate conversion.
struct RateConverter
{
    std::uint64_t serial = 0;
    double out = 0.0;                    ///< the value that arrives
    double gathered = 0.0;               ///< sum that has not been delivered yet
    double before = 0.0, newest = 0.0;   ///< the ends of the straight line (Conversion::Kind::line)
    bool begun = false;                  ///< `newest` is set

    /// Takes over the state of a conversion of a different kind, but not its serial number: the main thread may be reading the serial
    /// number of this converter to build the next plan. [tick thread]
    void adopt (const RateConverter& old) noexcept
    {
        out = old.out;
        gathered = old.gathered;
        before = old.before;
        newest = old.newest;
        begun = old.begun;
    }
};

/// Unique in a process. [any thread]
std::uint64_t newSerial() noexcept;

}   // namespace tactus::plan
