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

    /// Moves all tools to where the motion has them on a tick.
    void follow (const HandMotion&, std::size_t tick) noexcept;

    /// Moves the tool of a role away from where the motion has it, in m. It stays away until the next call of follow or shift.
    void shift (std::size_t role, const Vec3& by) noexcept;

    /// From now on, the outputs of these nodes have no effect: they are replaced by their values at the start, which are 0. [main thread]
    void silence (std::vector<std::size_t> nodes) { silent = std::move (nodes); }

    void tick() noexcept;

    const Vec3& force (std::size_t role) const noexcept { return plan().roles()[role].state->applied.force; }   ///< on the tool, in N
    const Plan& plan() const noexcept { return *its_plan; }

private:
    /// A tool that is wherever it is put.
    struct Placed final : Device
    {
        Reading now {};
        Vec3 home = Vec3::Zero(), true_home = Vec3::Zero();   // m
        DeviceLayout parts {};

        void prepare (double) override {}
        Reading read() noexcept override { return now; }
        void write (const Effort&) noexcept override {}
        DeviceLayout layout() const override { return parts; }
    };

    std::shared_ptr<Plan> its_plan;
    std::vector<std::unique_ptr<Placed>> tools;   // in the order of the plan's roles
    std::unique_ptr<Engine> engine;
    std::vector<std::size_t> silent;
};

/// The forces that a node computes: all outputs in N.
class NodeForces
{
public:
    NodeForces (const Plan&, std::size_t node);

    std::size_t size() const noexcept { return values.size(); }   ///< components of all outputs
    double operator[] (std::size_t i) const noexcept { return *values[i]; }
    double largest() const noexcept;   ///< length of the largest output

    const std::vector<std::size_t>& widths() const noexcept { return output_widths; }   ///< components of each output

private:
    std::vector<const double*> values;
    std::vector<std::size_t> output_widths;
};

}   // namespace tactus::check
