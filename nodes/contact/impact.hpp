// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <array>
#include <cmath>

namespace tactus::nodes
{

/// One hit per contact, with the speed of the approach: the trigger of vibrations and shocks.
///
/// Contact begins when depth rises above 0 and ends when depth falls to `release` below 0. On the first tick of a contact
///
///     hit = rate of depth over the last samples up to the contact
///
/// The window grows backwards from the contact for as long as every sample in it lies within `release`, which stands for the
/// noise, of the straight line from its first sample to its last: at least three samples if three are known, at most seventeen.
/// So a slow approach in steps of an encoder's quantum is averaged, a braking approach is not, and a steady one is exact in
/// either case.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 6 (where "initial value of d^z" means its rate);
/// the window is from Janabi-Sharifi, Hayward & Chen 2000.
///
/// Good to know
///  - `release` should be at least the resolution of the position, or one touch may count as several and the speed is noisy.
///  - With a position quantised in steps of q, the speed is within 2 q / (n T) of the true speed, where n is the number of ticks
///    in the window.
///  - A tool that is inside on the first sample, or after a fault, is in contact but triggers no hit. A contact that begins
///    within `refractory` of a hit, or slower than `min_speed`, never triggers one.
struct Impact
{
    struct Inputs
    {
        double depth = 0.0;
    };

    struct Params
    {
        double release = 1e-5;
        double min_speed = 0.0;
        double refractory = 0.0;
    };

    struct Outputs
    {
        double hit = 0.0;
        double contact = 0.0;
    };

    static constexpr Info info {
        .id = "contact.impact",
        .name = "Impact",
        .summary = "One hit per contact, with the speed of the approach.",
        .source = "Hayward 2007, section 6; Janabi-Sharifi et al. 2000",
    };

    static constexpr std::tuple ports {
        input (&Inputs::depth, "depth", unit::metre, "depth of the tool in the object; negative while apart"),
        param (&Params::release, "release", unit::metre, "distance outside the object at which a contact ends; at least the noise of depth",
               { .hard = { 0, inf }, .usual = { 0, 1e-3 } }),
        param (&Params::min_speed, "min_speed", unit::speed, "slowest touch that triggers a hit", { .hard = { 0, inf }, .usual = { 0, 0.5 } }),
        param (&Params::refractory, "refractory", unit::second, "time after a hit in which no other is triggered", { .hard = { 0, inf }, .usual = { 0, 0.2 } }),
        output (&Outputs::hit, "hit", unit::hit, "impact speed on the first tick of a contact, else 0"),
        output (&Outputs::contact, "contact", unit::state, "1 in contact, 0 apart"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        known = 0;
        touching = false;
        since_hit = inf;
    }

    Outputs tick (const Inputs& in) noexcept
    {
        since_hit += 1.0;
        if (! isFinite (in.depth))
        {
            known = 0;
            touching = false;
            return {};
        }

        if (touching && in.depth <= -params.release)
        {
            touching = false;
            known = 0;   // samples taken inside the object are not part of an approach
        }
        remember (in.depth);
        if (touching || in.depth <= 0.0) return { .contact = touching ? 1.0 : 0.0 };

        touching = true;
        const double v = approach();
        const bool rested = since_hit * dt >= params.refractory * (1.0 - 1e-12);
        if (! (v > 0.0 && v >= params.min_speed && rested && isFinite (v))) return { .contact = 1.0 };

        since_hit = 0.0;
        return { .hit = v, .contact = 1.0 };
    }

private:
    static constexpr int capacity = 17;

    void remember (double depth) noexcept
    {
        newest = (newest + 1) % capacity;
        depths[at (newest)] = depth;
        if (known < capacity) ++known;
    }

    double ago (int ticks) const noexcept { return depths[at ((newest + capacity - ticks) % capacity)]; }

    /// Rate of depth up to now, m/s; 0 without an earlier sample.
    double approach() const noexcept
    {
        if (known < 2) return 0.0;

        int n = 1;
        while (n + 1 < known && (n == 1 || straight (n + 1)))
            ++n;
        if (n == 2 && ago (0) <= ago (2)) n = 1;   // the tool has only just turned back towards the object
        return (ago (0) - ago (n)) / (n * dt);
    }

    /// True if each of the last n samples lies within `release` of the straight line from the sample n ticks ago to the newest one.
    bool straight (int n) const noexcept
    {
        const double slope = (ago (0) - ago (n)) / n;
        for (int i = 1; i < n; ++i)
            if (! (std::abs (ago (0) - slope * i - ago (i)) <= params.release)) return false;
        return true;
    }

    std::array<double, capacity> depths {};   // ring of the last depths, in m
    int newest = 0, known = 0;
    bool touching = false;
    double since_hit = inf;               // ticks
    double dt = 1.0 / Setup {}.rate_hz;   // s
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Impact);
