// SPDX-License-Identifier: MIT
#pragma once

/// A section at run time: one record of the enclosing section, with its own records inside.

#include <tactus/plan/plan.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace tactus::plan
{

/// Connects one component of a wire to the rate converter where it enters or leaves a section.
struct ConversionLink
{
    const double* from;
    RateConverter* converter;

    void latch() const noexcept { converter->out = *from; }
    void silence() const noexcept { converter->out = 0.0; }
    void gather() const noexcept { converter->gathered += *from; }
    void deliver() const noexcept
    {
        converter->out = converter->gathered;
        converter->gathered = 0.0;
    }

    /// Starts a new straight line where the last one ended. The first line begins and ends at the current input.
    void head() const noexcept
    {
        auto& p = *converter;
        p.before = p.begun ? p.newest : *from;
        p.newest = *from;
        p.begun = true;
    }

    /// Outputs the point on the line at a fraction from 0 to 1. Before the first line exists, outputs the current input.
    void follow (double part) const noexcept { converter->out = converter->begun ? std::lerp (converter->before, converter->newest, part) : *from; }
};

struct RunningSection
{
    /// A tap inside the section: collects all samples of a tick of the graph.
    struct Samples
    {
        const double* from;
        double* to;
        std::uint64_t per_tick;
    };

    const std::uint64_t* around = nullptr;   // tick number of the enclosing section
    std::uint64_t number = 0;                // tick number of this section
    std::uint64_t factor = 1;
    std::vector<ConversionLink> latches, gathers, lines, pulses;
    std::vector<Record> records;
    std::vector<Samples> samples;

    std::vector<ConversionLink>& linksOf (Conversion::Kind kind) noexcept
    {
        switch (kind)
        {
        case Conversion::Kind::latch:
            return latches;
        case Conversion::Kind::gather:
            return gathers;
        case Conversion::Kind::line:
            return lines;
        case Conversion::Kind::pulse:
            break;
        }
        return pulses;
    }

    /// Runs on every `factor`-th tick. Inputs are latched or gathered; outputs are lines, held values or pulses.
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

    /// Runs `factor` times per tick. Inputs are lines, held values or pulses; outputs are the last value, or gathered.
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
