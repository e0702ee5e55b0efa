// SPDX-License-Identifier: MIT
#pragma once

/// The parameters of a running node as they are turned live. A target may be set from any thread; the tick thread goes
/// there in a straight line, each parameter on its own. Choices are taken at once.

#include <framework/catalogue.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::plan
{

/// One component of a parameter, or one entry of a list.
struct Knob
{
    std::atomic<double> target = 0.0;
    std::atomic<std::uint32_t> turns = 0;   ///< how often a target was set

    // Of the tick thread.
    std::uint32_t heeded = 0;   ///< of these turns, what came of is under way, or outdone by an edit
    int left = 0;               ///< ticks of the ramp
    double to = 0.0;            ///< its end
    double value = 0.0;         ///< where it stands: the stored value, before wires
};

/// An input that takes hits, for those who strike from outside. What they ask for comes to what the wires bring, all of it on
/// the first tick on which the node runs.
struct Pulse
{
    std::atomic<double> asked = 0.0;   ///< m/s, the sum of all that were not looked at

    // Of the tick thread.
    double pending = 0.0;   ///< and that the node has not heard
};

bool takesHits (const PortSheet&) noexcept;

/// All knobs of a node, and its inputs for hits. They outlive the plan they were made for: a later one that holds the node
/// holds these too.
struct Knobs
{
    explicit Knobs (const NodeType& t) : type (t), all (indexOf (t, t.params.size(), 0)), pulses (static_cast<std::size_t> (std::ranges::count_if (t.inputs, takesHits))) {}

    /// True if there is anything of a node of this type that can be turned or struck.
    static bool areIn (const NodeType& t) noexcept { return ! t.params.empty() || std::ranges::any_of (t.inputs, takesHits); }

    /// A list has room for all entries it can ever have, so that none moves.
    static std::size_t roomOf (const PortSheet& row) noexcept { return static_cast<std::size_t> (row.list ? list_capacity : row.width); }

    /// Where a component of a param stands.
    static std::size_t indexOf (const NodeType& t, std::size_t param, std::size_t component) noexcept
    {
        for (std::size_t p = 0; p < param; ++p)
            component += roomOf (t.params[p]);
        return component;
    }

    const NodeType& type;
    std::vector<Knob> all;
    std::vector<Pulse> pulses;           ///< by input that takes hits, in the order of the datasheet
    std::atomic<bool> touched = false;   ///< one of them is

    // Of the tick thread.
    bool started = false;   ///< the node has ticked: from now on, values are ramped
    bool ramping = false;   ///< is in the list of those that are
};

bool isChoice (const NodeType&, std::size_t knob) noexcept;

/// A parameter as those who turn it hold it. What it names may be gone from the plan; then turning it does nothing.
struct ParamRef
{
    std::shared_ptr<Knobs> knobs;
    std::size_t index = 0;
    const PortSheet* sheet = nullptr;
};

/// Of a choice, the number of the alternative. A value that is not finite is passed over, one beyond the range of the
/// model stops at its end. [any thread]
void turn (const ParamRef&, double) noexcept;

/// An input for hits, likewise.
struct HitRef
{
    std::shared_ptr<Knobs> knobs;
    std::size_t index = 0;   ///< among its pulses
};

/// A speed in m/s that is not finite and positive is passed over. [any thread]
void strike (const HitRef&, double speed) noexcept;

}   // namespace tactus::plan
