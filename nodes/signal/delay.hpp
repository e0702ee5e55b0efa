// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <algorithm>
#include <vector>

namespace tactus::nodes
{

/// Delays a signal by a whole number of ticks, starting from 0.
///
/// The output does not depend on this tick's input, so a loop through this node can be computed. In a loop through the hand,
/// each tick of delay lowers the stiffness that stays stable, and the hand can feel the difference. A wire without a delay does
/// not lower it.
struct Delay
{
    using Inputs = In<double>;
    using Params = Empty;

    struct Settings
    {
        int ticks = 1;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.delay",
        .name = "Delay",
        .summary = "Delays a signal by a whole number of ticks.",
        .source = "definition",
        .keywords = "memory latency",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        setting (&Settings::ticks, "ticks", unit::count, "length of the delay in ticks", { .hard = { 1, 1e6 }, .usual = { 1, 100 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the delayed signal"),
    };

    Params params;
    Settings settings;

    Cost cost() const { return { .work = 0.2 * settings.ticks, .memory = 8.0 * settings.ticks }; }

    void prepare (const Setup&)
    {
        line.assign (at (settings.ticks), 0.0);
        now = 0;
    }

    /// Keeps the newest samples. A longer delay line repeats the oldest of them, so that nothing steps to 0.
    void adopt (const Delay& old) noexcept
    {
        const auto had = old.line.size();
        for (std::size_t age = 1; age <= line.size(); ++age)
            line[line.size() - age] = old.line[(old.now + had - std::min (age, had)) % had];
        now = 0;
    }

    int delay() const noexcept { return settings.ticks; }

    Outputs peek() const noexcept { return { .out = line[now] }; }

    void tick (const Inputs& in) noexcept
    {
        line[now] = isFinite (in.in) ? in.in : 0.0;
        if (++now == line.size()) now = 0;
    }

    void serialize (auto& archive)
    {
        archive (line);
        archive.index (now, line.size());
    }

private:
    std::vector<double> line { 0.0 };
    std::size_t now = 0;   // index of the oldest sample, which the next tick overwrites
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Delay);
