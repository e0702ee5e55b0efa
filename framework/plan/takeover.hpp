// SPDX-License-Identifier: MIT
#pragma once

#include "ramps.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tactus::plan
{

/// What is to be done when a plan takes over from another, worked out beforehand. Nodes that go on unchanged are the
/// same in both plans and need nothing. What is old here lives in the plan before.
struct Takeover
{
    /// A node made anew in the place of an old one of its type: takes over where the knobs stand and, if it ran and
    /// has a way to, the state.
    struct Successor
    {
        std::size_t instance;
        void (*adopt) (void* node, const void* old) noexcept;   ///< null: it starts afresh
        const void* old;
    };

    /// A value that is another one in the file. Who turned the parameter after that edit has the last word.
    struct Change
    {
        std::size_t instance, knob;
        double value;
        bool at_once;
        std::uint32_t turns;   ///< of the knob, before the edit
    };

    /// A parameter that a wire drove, and none does now: goes back to its stored value.
    struct Release
    {
        std::size_t instance, knob;
    };

    /// A wire with another delay.
    struct Relay
    {
        Line* line;
        const Line* old;
    };

    /// A wire that enters or leaves a section in another way.
    struct Passing
    {
        Passage* passage;
        const Passage* old;
    };

    /// What stands in a section that rests until its next tick.
    struct Standing
    {
        void* to;
        const void* from;
        std::size_t bytes;
    };

    std::vector<Successor> successors;
    std::vector<Change> changes;
    std::vector<Release> releases;
    std::vector<Relay> relays;
    std::vector<Passing> passings;
    std::vector<Standing> standing;

    void carryOut (std::span<const Instance>, Ramps&, Journal*) const noexcept;   // [tick thread]
};

}   // namespace tactus::plan
