// SPDX-License-Identifier: MIT
#pragma once

/// Knobs turn the parameters of a running node. Any thread may set a target; the tick thread ramps each parameter to its
/// target in a straight line. Choices apply immediately, and so does a limit that is set or taken away.

#include "inline_array.hpp"
#include "knob_board.hpp"

#include <tactus/node/catalogue.hpp>

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
    std::atomic<std::uint32_t> turns = 0;   ///< number of times a target was set

    // Tick thread only.
    std::uint32_t heeded = 0;   ///< value of `turns` for the last target that was applied, or was replaced by an edit
    int left = 0;               ///< ticks left in the ramp
    double to = 0.0;            ///< end of the ramp
    double value = 0.0;         ///< current stored value, before wires replace it or add to it
};

/// A hit input as seen from outside the graph. Hits from outside are added to the hits from wires, all on the next tick on
/// which the node runs.
struct Pulse
{
    std::atomic<double> asked = 0.0;   ///< the sum of all hits that the tick thread has not picked up, in m/s

    // Tick thread only.
    double pending = 0.0;   ///< the sum of all hits that were picked up but not yet passed to the node, in m/s
};

bool takesHits (const PortSheet&) noexcept;

/// All knobs and hit inputs of a node. They outlive the plan they were made for: a later plan that contains the same node
/// shares them.
struct Knobs
{
    /// Takes a place on the board. [main thread]
    Knobs (const NodeType& t, std::shared_ptr<KnobBoard> b)
        : type (t), all (indexOf (t, t.params.size(), 0)), pulses (static_cast<std::size_t> (std::ranges::count_if (t.inputs, takesHits))),
          board (std::move (b)), place (board->add())
    {
    }

    /// True if a node of this type has params or hit inputs.
    static bool areIn (const NodeType& t) noexcept { return ! t.params.empty() || std::ranges::any_of (t.inputs, takesHits); }

    /// Number of knobs for a param. A list has a knob for each entry it can ever have, so that knobs never move.
    static std::size_t roomOf (const PortSheet& row) noexcept { return static_cast<std::size_t> (row.list ? list_capacity : row.width); }

    /// Index of the knob for a component of a param.
    static std::size_t indexOf (const NodeType& t, std::size_t param, std::size_t component) noexcept
    {
        for (std::size_t p = 0; p < param; ++p)
            component += roomOf (t.params[p]);
        return component;
    }

    const NodeType& type;
    InlineArray<Knob, 2> all;    ///< most nodes have one or two
    std::vector<Pulse> pulses;   ///< by input that takes hits, in the order of the datasheet

    const std::shared_ptr<KnobBoard> board;   ///< where the tick thread sees that a knob or pulse has changed
    const std::uint32_t place;                ///< on the board

    // Tick thread only.
    bool continues = false;   ///< the node replaces one that has ticked, so new targets start a ramp from its first tick on
    bool ramping = false;     ///< the node is in the list of nodes with a ramp

    /// True once new targets start a ramp. [tick thread]
    bool hasStarted() const noexcept { return continues || board->started; }
};

/// True if a knob changes at once: a choice, and a limit that is set or taken away.
bool jumps (const NodeType&, std::size_t knob, double from, double to) noexcept;

/// A handle for turning a parameter. If the node is no longer in the plan, turning does nothing.
struct ParamRef
{
    std::shared_ptr<Knobs> knobs;
    std::size_t index = 0;
    const PortSheet* sheet = nullptr;
};

/// Sets the target of a parameter; for a choice, the number of the alternative. Ignores a value that is not finite, and clamps
/// the others to the hard limits of the datasheet. [any thread]
void turn (const ParamRef&, double) noexcept;

/// A handle for triggering hits at an input.
struct HitRef
{
    std::shared_ptr<Knobs> knobs;
    std::size_t index = 0;   ///< index in Knobs::pulses
};

/// Triggers a hit with a speed in m/s. Ignores a speed that is not finite and positive. [any thread]
void strike (const HitRef&, double speed) noexcept;

}   // namespace tactus::plan
