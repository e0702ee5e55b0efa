// SPDX-License-Identifier: MIT
#pragma once

/// A section as it runs: one record of the section around it, with records of its own.

#include "plan.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace tactus::plan
{

/// One component of a wire where it enters or leaves a section.
struct Crossing
{
    const double* from;
    Passage* passage;

    void latch() const noexcept { passage->out = *from; }
    void silence() const noexcept { passage->out = 0.0; }
    void gather() const noexcept { passage->gathered += *from; }
    void deliver() const noexcept
    {
        passage->out = passage->gathered;
        passage->gathered = 0.0;
    }

    /// The line goes on from where it ended; the first has one end only.
    void head() const noexcept
    {
        auto& p = *passage;
        p.before = p.begun ? p.newest : *from;
        p.newest = *from;
        p.begun = true;
    }

    /// A part of the line, up to 1. Before it has begun, what stands there.
    void follow (double part) const noexcept { passage->out = passage->begun ? std::lerp (passage->before, passage->newest, part) : *from; }
};

struct RunningSection
{
    /// A tap inside: all samples of a tick of the graph.
    struct Samples
    {
        const double* from;
        double* to;
        std::uint64_t per_tick;
    };

    const std::uint64_t* around = nullptr;   // number of the tick of the section around
    std::uint64_t number = 0;                // of its own
    std::uint64_t factor = 1;
    std::vector<Crossing> latches, gathers, lines, pulses;
    std::vector<Record> records;
    std::vector<Samples> samples;

    /// What enters is latched or gathered; what leaves goes in lines, stands still, or is a pulse.
    static void every (void* self, const double* const*, void*) noexcept
    {
        auto& s = *static_cast<RunningSection*> (self);
        for (const auto& c : s.gathers)
            c.gather();

        const auto phase = *s.around % s.factor;
        if (phase == 0)
        {
            s.number = *s.around / s.factor;
            for (const auto& c : s.latches)
                c.latch();
            for (const auto& c : s.gathers)
                c.deliver();
            s.run();
            for (const auto& c : s.lines)
                c.head();
        }
        for (const auto& c : s.lines)
            c.follow (static_cast<double> (phase) / static_cast<double> (s.factor));
        for (const auto& c : s.pulses)
            phase == 0 ? c.latch() : c.silence();
    }

    /// What enters goes in lines, stands still, or is a pulse; what leaves is what stands at the end, or gathered.
    static void times (void* self, const double* const*, void*) noexcept
    {
        auto& s = *static_cast<RunningSection*> (self);
        for (const auto& c : s.lines)
            c.head();
        for (const auto& c : s.pulses)
            c.latch();
        for (std::uint64_t i = 0; i < s.factor; ++i)
        {
            s.number = *s.around * s.factor + i;
            for (const auto& c : s.lines)
                c.follow (static_cast<double> (i + 1) / static_cast<double> (s.factor));
            if (i == 1)
                for (const auto& c : s.pulses)
                    c.silence();
            s.run();
            for (const auto& c : s.gathers)
                c.gather();
            for (const auto& tap : s.samples)
                tap.to[s.number % tap.per_tick] = *tap.from;
        }
        for (const auto& c : s.gathers)
            c.deliver();
    }

private:
    void run() const noexcept
    {
        for (const auto& r : records)
            r.step (r.self, r.sources, r.outputs);
    }
};

}   // namespace tactus::plan
