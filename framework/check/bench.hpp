// SPDX-License-Identifier: MIT
#pragma once

#include "hand_motion.hpp"

#include <tactus/run/engine.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tactus::check
{

/// A graph whose tools are placed from outside, tick by tick.
class Bench
{
public:
    /// The graph must compile: measure() checks that first. [main thread]
    Bench (const Subject&, const HandMotion&);

    /// Moves all tools to their positions in the motion at a tick. A fraction of a tick lies on the straight line between the positions
    /// of two ticks.
    void follow (const HandMotion&, double tick) noexcept;

    /// Moves the tool of a role, or an axis, away from its position in the motion, in m, until the next call to follow or shift.
    void shift (std::size_t role, const Vec3& by) noexcept;

    /// From now on, the outputs of these nodes are 0, their value at the start. [main thread]
    void silence (const std::vector<std::size_t>& nodes);

    /// Throws Stopped if the subject is stopped.
    void tick();

    /// On the tool, in N, or on the axis along x, in N or N m. `role`: in the order of the motion.
    Vec3 force (std::size_t role) const noexcept
    {
        if (role < tools.size()) return applied (role).force;
        const auto& axis = axes[role - tools.size()];
        return { applied (axis.owner).axes[axis.pushed], 0.0, 0.0 };
    }

    double brake (std::size_t role) const noexcept { return role < tools.size() ? applied (role).brake : 0.0; }   ///< in N s/m

    /// Of the tool, without the shift, in m.
    Vec3 position (std::size_t role) const noexcept
    {
        if (role < tools.size()) return tools[role]->home;
        const auto& axis = axes[role - tools.size()];
        return { tools[axis.owner]->home_axes[axis.read], 0.0, 0.0 };
    }
    const Plan& plan() const noexcept { return *its_plan; }

private:
    /// A device whose tool stays where it is put.
    struct Placed final : Device
    {
        Reading now {};
        Vec3 home = Vec3::Zero(), true_home = Vec3::Zero();   // in the motion, without the shift, in m
        Channels home_axes {};
        DeviceLayout parts {};

        void prepare (double) override {}
        Reading read() noexcept override { return now; }
        void write (const Effort&) noexcept override {}
        DeviceLayout layout() const override { return parts; }
    };

    std::shared_ptr<Plan> its_plan;
    std::vector<std::unique_ptr<Placed>> tools;   // in the order of the plan's roles
    std::vector<DrivenAxis> axes;                 // after the tools in the motion
    std::unique_ptr<Engine> engine;
    std::stop_token stop;
    std::vector<bool> silent;   // by node; empty if none is

    const Effort& applied (std::size_t role) const noexcept { return plan().roles()[role].state->applied; }
};

/// Ticks a plan while some nodes, given by number, are silent: their outputs are as at the start.
void tickWithout (Plan&, const std::vector<bool>& silent) noexcept;

/// The forces of all roles along a motion, by role, then tick.
using Forces = std::vector<std::vector<Vec3>>;

/// Runs a graph once along the motion. Calls after (plan) after each tick.
template <typename AfterTick>
Forces forcesAlong (Bench& bench, const HandMotion& motion, AfterTick&& after)
{
    Forces forces (motion.roles.size());
    for (std::size_t k = 0; k < motion.ticks; ++k)
    {
        bench.follow (motion, static_cast<double> (k));
        bench.tick();
        for (std::size_t r = 0; r < forces.size(); ++r)
            forces[r].push_back (bench.force (r));
        after (bench.plan());
    }
    return forces;
}

/// The same with a bench of its own, on which the nodes `without` are silent.
template <typename AfterTick>
Forces forcesAlong (const Subject& subject, const HandMotion& motion, const std::vector<std::size_t>& without, AfterTick&& after)
{
    Bench bench { subject, motion };
    bench.silence (without);
    return forcesAlong (bench, motion, after);
}

/// The forces that a node computes: all its outputs in N.
class NodeForces
{
public:
    NodeForces (const Plan&, std::size_t node);

    std::size_t size() const noexcept { return values.size(); }   ///< number of components of all outputs together
    double operator[] (std::size_t i) const noexcept { return *values[i]; }
    double largest() const noexcept;   ///< magnitude of the largest output, in N

    const std::vector<std::size_t>& widths() const noexcept { return output_widths; }   ///< number of components of each output

private:
    std::vector<const double*> values;
    std::vector<std::size_t> output_widths;
};

}   // namespace tactus::check
