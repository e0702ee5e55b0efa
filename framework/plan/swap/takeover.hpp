// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/steps/ramps.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::plan
{

/// The work to do when a plan takes over from another, computed beforehand. Both plans share the unchanged nodes, so these need
/// no work. All old objects belong to the previous plan.
struct Takeover
{
    /// A new node that replaces an old one of the same type. It takes over the knob values and, if the old one ran and the type
    /// supports it, the state.
    struct Successor
    {
        std::size_t instance;
        void (*adopt) (void* node, const void* old) noexcept;   ///< null: the new node starts from its initial state
        const void* old;
    };

    /// A node whose type was compiled again, as after an edit of its C++ code. Its knobs are new, and take over the values of the old ones.
    struct Rebuilt
    {
        std::size_t instance;
        const Knobs* old;
    };

    /// A parameter whose stored value was edited. If the knob was turned after the edit, the turned value takes precedence.
    struct Change
    {
        std::size_t instance, knob;
        double value;
        bool at_once;
        std::uint32_t turns;   ///< Knob::turns before the edit
    };

    /// A parameter that is no longer driven by a wire: it ramps back to its stored value.
    struct Release
    {
        std::size_t instance, knob;
    };

    /// A delayed wire whose delay has changed.
    struct Relay
    {
        Line* line;
        const Line* old;
    };

    /// A wire whose rate conversion has changed.
    struct Conversion
    {
        RateConverter* converter;
        const RateConverter* old;
    };

    /// A value to copy from the previous plan and to hold until the section of its node next runs.
    struct HeldValue
    {
        void* to;
        const void* from;
        std::size_t bytes;
    };

    std::vector<Successor> successors;
    std::vector<Rebuilt> rebuilt;
    std::vector<Change> changes;
    std::vector<Release> releases;
    std::vector<Relay> relays;
    std::vector<Conversion> conversions;
    std::vector<HeldValue> held;

    void carryOut (const std::vector<Instance>&, Ramps&, const Ramps& before, Journal*) const noexcept;   // [tick thread]
};

}   // namespace tactus::plan
