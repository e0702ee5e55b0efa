// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <algorithm>
#include <vector>

namespace tactus::nodes
{

/// Holds a signal back by a whole number of ticks, starting from 0.
///
/// Its output does not depend on this tick's input, so a loop through it can be computed. In a loop through the hand
/// each tick of delay costs stiffness that the hand can feel; a wire without a delay costs none.
struct Delay
{
    struct Inputs
    {
        double in = 0.0;
    };

    struct Params
    {
    };

    struct Settings
    {
        int ticks = 1;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.delay",
        .name = "Delay",
        .summary = "Holds a signal back by a whole number of ticks.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        setting (&Settings::ticks, "ticks", unit::count, "how many ticks it is held back", { .hard = { 1, 1e6 }, .usual = { 1, 100 } }),
        output (&Outputs::out, "out", sameAs ("in"), "the signal, that many ticks ago"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup&)
    {
        line.assign (static_cast<std::size_t> (settings.ticks), 0.0);
        now = 0;
    }

    /// The newest samples stay; a longer line repeats the oldest of them, so that nothing steps to 0.
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

private:
    std::vector<double> line { 0.0 };
    std::size_t now = 0;   // oldest sample
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Delay);
