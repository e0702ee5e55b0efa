// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace tactus::nodes
{

/// One hit per contact, with the speed of the approach: the trigger of vibrations and shocks.
///
/// Contact begins when depth rises above 0 and ends when depth falls to `release` below 0. On the first tick of a contact
///
///     hit = rate of depth over the last samples up to the contact
///
/// The speed is the slope of a straight line from an earlier sample to the first sample in contact. Only arrivals count: samples
/// at which depth is higher than ever before in this approach. When depth arrives at a step of the encoder for the first time,
/// the position of the tool is known. Between two steps it is not known, nor while the encoder flickers between two values. The
/// line reaches back over at least two arrivals, and further while all of them lie within the noise of a straight line, but not
/// beyond `window`. So a slow approach in steps of an encoder's quantum is averaged, and a braking approach is not. A steady approach
/// with exact positions gives the exact speed.
///
/// An approach begins where the tool last turned back towards the object. A retreat by less than 1.5 times the noise does not count.
///
/// The noise is `release` or the quantum of the encoder, whichever is larger. The node takes as the quantum the largest length that
/// divides all steps so far, if that length is at most 0.1 mm. For exact positions the length soon becomes 0.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 6 (where "initial value of d^z" means its rate);
/// the line of variable length is from Janabi-Sharifi, Hayward & Chen 2000.
///
/// Good to know
///  - Noise and window are in metres and seconds, not in ticks, so the speed does not depend on the tick rate. For a steady
///    approach at 5 mm/s or more in steps of 50 um, it is within 5 %, with a window of 40 ms and a rate of 1 kHz or more, even if
///    the encoder flickers at each step because of a jitter of 0.02 quanta rms; within 7 % with 0.04 and 12 % with 0.1 quanta rms.
///  - A braking approach is averaged at most over the time in which it departs from a straight line by the noise. So a large
///    `release` makes the speed of a braking tool too high: by a few percent with 50 um, 0.3 m/s and 5 m/s2.
///  - If the position has noise other than encoder steps, or the object is tilted against the axes of the device, set `release` to
///    at least the noise. Otherwise one touch may count as several, and the speed is noisy.
///  - A contact ends no sooner than one quantum outside the object.
///  - A tool that is inside on the first sample, or after a fault, is in contact but triggers no hit. A contact that begins
///    within `refractory` of a hit, or slower than `min_speed`, never triggers one.
struct Impact
{
    struct Inputs
    {
        Fine depth = 0.0;
    };

    struct Params
    {
        double release = 1e-5;
        double min_speed = 0.0;
        double refractory = 0.0;
        double window = 0.04;
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
        .keywords = "collision hit tap onset",
    };

    static constexpr double longest_window = 0.1;   // s

    static constexpr std::tuple ports {
        input (&Inputs::depth, "depth", unit::metre, "depth of the tool in the object; negative while apart"),
        param (&Params::release, "release", unit::metre, "distance outside the object at which a contact ends; at least the noise of depth",
               { .hard = { 0, inf }, .usual = { 0, 1e-3 } }),
        param (&Params::min_speed, "min_speed", unit::speed, "slowest touch that triggers a hit", { .hard = { 0, inf }, .usual = { 0, 0.5 } }),
        param (&Params::refractory, "refractory", unit::second, "time after a hit in which no other is triggered", { .hard = { 0, inf }, .usual = { 0, 0.2 } }),
        param (&Params::window, "window", unit::second, "longest time over which the speed is measured",
               { .hard = { 0, longest_window }, .usual = { 0.005, 0.05 } }),
        output (&Outputs::hit, "hit", unit::hit, "impact speed on the first tick of a contact, else 0"),
        output (&Outputs::contact, "contact", unit::state, "1 in contact, else 0"),
    };

    Params params;

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        depths.assign (at (static_cast<int> (std::ceil (longest_window / dt)) + 3), 0.0);
        arrivals.assign (depths.size(), 0);
        newest = known = 0;
        touching = false;
        common = 0.0;
        is_exact = false;
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

        if (known > 0) learn (std::abs (in.depth - ago (0)));
        if (touching && in.depth <= -noise())
        {
            touching = false;
            known = 0;   // samples taken inside the object are not part of an approach
        }
        remember (in.depth);
        if (touching || in.depth <= 0.0) return { .contact = touching ? 1.0 : 0.0 };

        touching = true;
        const double v = approach();
        const bool rested = since_hit * dt >= params.refractory * (1.0 - margin (1e-12));
        if (! (v > 0.0 && v >= params.min_speed && rested && isFinite (v))) return { .contact = 1.0 };

        since_hit = 0.0;
        return { .hit = v, .contact = 1.0 };
    }

    void serialize (auto& archive)
    {
        archive (depths, touching, common, is_exact, since_hit);
        archive.index (newest, depths.size());
        archive.index (known, depths.size() + 1);
    }

private:
    static constexpr double rounding = 1e-10;                 // m; smaller differences are rounding
    static constexpr double finest = 1e-8, coarsest = 1e-4;   // m; limits for the quantum of an encoder

    /// The quantum of the encoder, or 0 if the positions are exact. A little less than computed, to allow for rounding.
    double quantum() const noexcept { return ! is_exact && common <= coarsest ? common * (1.0 - margin (1e-6)) : 0.0; }

    double noise() const noexcept { return std::max (params.release, quantum()); }

    /// Updates the largest common divisor of all steps with this step, by Euclid's algorithm.
    void learn (double step) noexcept
    {
        if (is_exact || ! (step > rounding)) return;
        while (step > rounding)
            common = std::exchange (step, common > 0.0 ? std::abs (math::remainder (common, step)) : 0.0);
        is_exact = ! (common > finest);
    }

    void remember (double depth) noexcept
    {
        newest = newest + 1 < capacity() ? newest + 1 : 0;
        depths[at (newest)] = depth;
        known = std::min (known + 1, capacity());
    }

    int capacity() const noexcept { return static_cast<int> (depths.size()); }

    double ago (int ticks) const noexcept
    {
        const int place = newest - ticks;
        return depths[at (place >= 0 ? place : place + capacity())];
    }

    /// Rate of depth up to now, m/s; 0 without an earlier sample.
    double approach() noexcept
    {
        const int longest = std::min (known - 1, std::max (1, static_cast<int> (params.window / dt * (1.0 + margin (1e-9)))));
        if (longest < 1) return 0.0;
        const int n = line (longest);
        return (ago (0) - ago (n)) / (n * dt);
    }

    /// How many ticks ago the approach began: at the lowest depth since the last retreat, at most `longest` ticks ago. If the encoder rested
    /// at this depth, the approach began when it arrived there, because the tool may have moved since. With exact positions, the approach
    /// began when the tool left this depth.
    int beginning (int longest) const noexcept
    {
        const double flicker = 1.5 * noise(), same = quantum() > 0.0 ? rounding : -rounding;
        double lowest = ago (0);
        int begins = 0;
        for (int n = 1; n <= longest && ! (ago (n) > lowest + flicker); ++n)
        {
            if (ago (n) > lowest + same) continue;
            begins = n;
            lowest = std::min (lowest, ago (n));
        }
        return begins;
    }

    /// Lists the arrivals of this approach, the newest last, without the sample in contact. Returns their number.
    int listArrivals (int begins, int longest) noexcept
    {
        // An encoder may have rested where the approach begins: the position of the tool is not known then. An exact position always is.
        const bool is_known = quantum() == 0.0 && begins <= longest;
        int count = 0;
        if (is_known && begins > 0) arrivals[at (count++)] = begins;

        double highest = ago (begins);
        for (int n = begins - 1; n > 0; --n)
        {
            if (! (ago (n) > highest + rounding)) continue;
            highest = ago (n);
            if (n <= longest) arrivals[at (count++)] = n;
        }
        return count;
    }

    /// Length of the line in ticks. All lines with slopes from `least` to `most` pass within the noise of every arrival so far.
    int line (int longest) noexcept
    {
        const int begins = beginning (std::min (known - 1, longest + 1)), count = listArrivals (begins, longest);
        const double play = noise() * (1.0 + 2.0 * margin (1e-6));
        double least = -inf, most = inf;
        int best = std::clamp (begins, 1, longest);   // if there is no arrival, the tool was at rest for all of this time
        for (int i = count - 1, used = 0; i >= 0 && least <= most; --i, ++used)
        {
            const int n = arrivals[at (i)];
            const double slope = (ago (0) - ago (n)) / n;
            if (used < 2 || (slope >= least && slope <= most)) best = n;
            least = std::max (least, slope - play / n);
            most = std::min (most, slope + play / n);
        }
        return best;
    }

    std::vector<int> arrivals { 0, 0 };        // how many ticks ago this approach had its arrivals
    std::vector<double> depths { 0.0, 0.0 };   // ring of the last depths, in m
    int newest = 0, known = 0;
    bool touching = false;
    double common = 0.0;                  // largest common divisor of all steps, in m
    bool is_exact = false;                // true once the steps have no common divisor
    double since_hit = inf;               // ticks
    double dt = 1.0 / Setup {}.rate_hz;   // s
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Impact);
