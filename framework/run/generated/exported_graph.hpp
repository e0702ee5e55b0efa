// SPDX-License-Identifier: MIT
#pragma once

/// What the code that `tactus export` writes uses: the parts of a plan and of the engine that are not nodes. Each of them gives the
/// same bits as its counterpart in framework/plan and framework/run/engine.cpp. Nothing here allocates, throws or locks, and all
/// functions are for the thread that ticks the graph.

#include "driven.hpp"
#include <tactus/run/guard.hpp>
#include <tactus/run/guard/effort_sum.hpp>

#include <tactus/node/node.hpp>
#include <tactus/plan/sum.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

namespace tactus::exported
{

using generated::Driven;
using generated::not_a_number;

/// The sum of several wires. They are added in order of value, so the order of the wires does not matter.
template <typename... T>
auto sumOf (T... values) noexcept
{
    using Sum = std::remove_cvref_t<decltype ((values + ...))>;
    if constexpr (sizeof...(T) <= plan::most_in_network)
        return plan::sumOf (Sum (values)...);
    else
    {
        Sum all[] { values... };
        return plan::sum (all, static_cast<int> (sizeof...(T)));
    }
}

/// The sum of all sinks of a role.
template <std::size_t n>
Effort total (const std::array<Effort, n>& efforts) noexcept
{
    if constexpr (n == 1) return efforts[0];
    std::array<double, n + 1> numbers;   // one more, because an array of no numbers has no data
    return sumOfEfforts (efforts, numbers.data());
}

/// Puts a node into its initial state.
template <typename N>
void renew (N& node)
{
    std::destroy_at (&node);
    std::construct_at (&node);
}

/// Runs the node's optional hooks that follow its params and settings.
template <Node N>
void start (N& node, double rate_hz)
{
    const Setup setup { .rate_hz = rate_hz };
    if constexpr (Preparable<N>) node.prepare (setup);
    if constexpr (Updatable<N>) node.update();
}

/// A device as the graph sees it, and the guard between the two. The limits are those of the patch, and can only be tightened.
class Role
{
public:
    Role (const GuardLimits& of_patch, DeviceLayout of_device) : layout (std::move (of_device)), all (of_patch) {}

    DeviceLayout layout;    ///< what the graph describes. Change it before ExportedGraph::prepare to that of the real device
    DeviceState state {};   ///< what the nodes read; tick() sets it
    Guard guard {};
    const Effort* instead = nullptr;   ///< if set, this effort passes the guard to the device, in place of what the graph asks for

    const GuardLimits& limits() const noexcept { return all; }

    /// Tightens the limits to those of the real device. A limit that is looser than what the role has changes nothing, and neither does
    /// workspace_scale. Returns false, and does nothing, after the first tick since prepare.
    bool tighten (GuardLimits more) noexcept
    {
        if (has_begun) return false;
        more.workspace_scale = 1.0;
        all = tightest (all, more);
        guard.prepare (all, dt, layout);
        return true;
    }

    /// Resets the role. The nodes see the layout from meet() on, after they are prepared, as in the engine.
    void prepare (double dt_s) noexcept
    {
        state.reading = {};
        state.applied = {};
        state.layout = {};
        dt = dt_s;
        has_begun = is_ready = false;
        guard.prepare (all, dt, layout);
    }

    void meet()
    {
        state.layout = layout;
        is_ready = true;
    }

    /// Whether the graph is prepared: before that, nodes have no device, and the guard has no limits.
    bool isReady() const noexcept { return is_ready; }

    void read (const Reading& now) noexcept
    {
        state.reading = now;
        state.applied.force -= now.unrendered_force;
        state.applied.torque -= now.unrendered_torque;
    }

    /// Passes the effort that the graph wants through the guard. `lost_s` is the time without ticks before this one.
    const Effort& write (const Effort& wanted, double lost_s) noexcept
    {
        has_begun = true;
        state.applied = guard (instead != nullptr ? *instead : wanted, state.reading, dt + lost_s);
        return state.applied;
    }

private:
    GuardLimits all;
    double dt = 1.0;
    bool has_begun = false, is_ready = false;
};

/// One component of a parameter.
struct Parameter
{
    void* place = nullptr;   ///< the member of the node: a double, or the int of a choice
    bool is_choice = false;
    bool off_at_zero = false;   ///< 0 means that there is no limit, so no ramp leads there or away
    bool is_driven = false;     ///< a wire sets the member; the value here is what it replaces or adds to
    bool asked = false;         ///< a new target was set since the last tick
    int left = 0;               ///< ticks left in the ramp
    double min = 0.0, max = 0.0;
    double target = 0.0, to = 0.0, value = 0.0;

    void write() const noexcept
    {
        if (is_driven) return;
        if (is_choice)
        {
            const int chosen = static_cast<int> (value);
            std::memcpy (place, &chosen, sizeof chosen);
        }
        else
            *static_cast<double*> (place) = value;
    }
};

/// The parameters of one node: `count` of them, from number `first`.
struct NodeParameters
{
    std::size_t first = 0, count = 0;
    void* node = nullptr;
    void (*update) (void* node) noexcept = nullptr;   ///< null if the node has no update()
    bool is_ramping = false;
};

/// All parameters of a graph. A new target is reached in a straight line within ramp_s; a choice changes at once, and so does every
/// parameter before the first tick.
template <std::size_t parameters, std::size_t nodes>
class Parameters
{
public:
    static constexpr double ramp_s = 0.020;

    void prepare (double rate_hz) noexcept
    {
        all.fill ({});
        by_node.fill ({});
        ticks = std::max (1, static_cast<int> (std::lround (ramp_s * rate_hz)));
        is_touched = is_started = false;
        node_count = ramping = 0;
    }

    /// Begins the parameters of the next node; number `first` is the first of them.
    template <Node N>
    void of (N& node, std::size_t first) noexcept
    {
        auto& group = by_node[node_count++];
        group.first = first;
        group.node = &node;
        if constexpr (Updatable<N>) group.update = [] (void* n) noexcept { static_cast<N*> (n)->update(); };
    }

    /// Places the next parameter of this node: its member, value and hard range.
    void place (double& member, double value, double min, double max, bool off_at_zero = false) noexcept
    {
        member = value;
        add ({ .place = &member, .off_at_zero = off_at_zero, .min = min, .max = max, .target = value, .to = value, .value = value });
    }

    /// The same for a choice, whose value is the number of the alternative.
    template <typename Choice>
    requires std::is_enum_v<Choice>
    void place (Choice& member, int value, int alternatives) noexcept
    {
        member = static_cast<Choice> (value);
        const double v = value;
        add ({ .place = &member, .is_choice = true, .max = alternatives - 1.0, .target = v, .to = v, .value = v });
    }

    /// A wire sets this parameter.
    void drive (std::size_t i) noexcept { all[i].is_driven = true; }

    /// Sets the target of a parameter. A value that is not finite is ignored; others are clamped to the hard range.
    void set (std::size_t i, double value) noexcept
    {
        if (! isFinite (value)) return;
        all[i].target = Interval { all[i].min, all[i].max }.clamp (value);
        all[i].asked = is_touched = true;
    }

    double target (std::size_t i) const noexcept { return all[i].target; }

    /// The current value, before wires replace it or add to it.
    const double& stored (std::size_t i) const noexcept { return all[i].value; }

    /// Starts the ramps to new targets, and moves all ramps by one tick.
    void tick() noexcept
    {
        if (is_touched) poll();
        is_started = true;
        if (ramping > 0) step();
    }

private:
    void add (const Parameter& p) noexcept
    {
        auto& group = by_node[node_count - 1];
        all[group.first + group.count++] = p;
    }

    void poll() noexcept
    {
        is_touched = false;
        for (std::size_t n = 0; n < node_count; ++n)
            for (auto i = by_node[n].first; i < by_node[n].first + by_node[n].count; ++i)
                if (all[i].asked) head (all[i], by_node[n]);
    }

    void head (Parameter& p, NodeParameters& group) noexcept
    {
        p.asked = false;
        p.to = p.target;
        const bool jumps = p.off_at_zero && ! p.is_driven && (p.value == 0.0 || p.to == 0.0);
        if (! is_started || p.is_choice || jumps)
        {
            p.left = 0;
            p.value = p.to;
            p.write();
            if (! p.is_driven && group.update) group.update (group.node);
            return;
        }
        p.left = ticks;
        if (! group.is_ramping) ++ramping;
        group.is_ramping = true;
    }

    void step() noexcept
    {
        for (std::size_t n = 0; n < node_count; ++n)
            if (by_node[n].is_ramping) step (by_node[n]);
    }

    void step (NodeParameters& group) noexcept
    {
        bool more = false, moved = false;
        for (auto i = group.first; i < group.first + group.count; ++i)
        {
            auto& p = all[i];
            if (p.left == 0) continue;
            p.value = p.left == 1 ? p.to : p.value + (p.to - p.value) / p.left;
            more = --p.left > 0 || more;
            moved = moved || ! p.is_driven;
            p.write();
        }
        if (moved && group.update) group.update (group.node);
        if (more) return;
        group.is_ramping = false;
        --ramping;
    }

    std::array<Parameter, parameters> all {};
    std::array<NodeParameters, nodes> by_node {};
    std::size_t node_count = 0;
    std::size_t ramping = 0;   // how many nodes have a ramp
    int ticks = 1;             // length of a ramp
    bool is_touched = false, is_started = false;
};

/// Hits from outside, for one input.
struct Hits
{
    double asked = 0.0, pending = 0.0;

    void strike (double speed) noexcept
    {
        if (isFinite (speed) && speed > 0.0) asked += speed;
    }

    void poll() noexcept
    {
        if (asked == 0.0) return;
        pending += asked;
        asked = 0.0;
    }

    /// What the input reads: its wires, and the hits since the last time.
    double operator() (double from) noexcept
    {
        if (pending == 0.0) return from;
        from += pending;
        pending = 0.0;
        return from;
    }
};

/// One component of a wire with a delay: read at the start of a tick, written at its end.
template <std::size_t ticks>
struct DelayLine
{
    std::array<double, ticks> samples {};
    std::size_t now = 0;

    double read() const noexcept { return samples[now]; }

    void write (double value) noexcept
    {
        samples[now] = value;
        if (++now == ticks) now = 0;
    }
};

/// One component of a wire where it enters or leaves a part of the graph that runs at another rate. One of these per conversion:
struct Gathered   ///< the sum of all values since the last delivery
{
    double out = 0.0, sum = 0.0;

    void gather (double value) noexcept { sum += value; }
    void deliver() noexcept
    {
        out = sum;
        sum = 0.0;
    }
};

struct Line   ///< a straight line from the previous value to the newest
{
    double out = 0.0, before = 0.0, newest = 0.0;
    bool has_begun = false;

    void head (double value) noexcept
    {
        before = has_begun ? newest : value;
        newest = value;
        has_begun = true;
    }

    /// Goes to a fraction, 0…1, of the line. Before there is one, passes the value on.
    void follow (double value, double part) noexcept { out = has_begun ? std::lerp (before, newest, part) : value; }
};

struct Held   ///< the value at one time, or a pulse that lasts one tick
{
    double out = 0.0;
};

}   // namespace tactus::exported
