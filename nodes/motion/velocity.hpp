// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tactus::nodes
{

/// Velocity from quantised positions: fast when the hand moves fast, quiet when it does not.
///
/// The difference of two samples turns one quantum q of an encoder into a speed of q / T. Averaging over n samples divides this
/// by n, but lags. So the window adapts, per axis and per sample:
///
///     velocity = (p_k - p_(k-n)) / (n T)
///
/// where n is the largest number for which the line through p_(k-n) and p_k passes within `noise` of every sample between, up to
/// `max_window` or the number of ticks in `window`. A braking hand shortens the window immediately; the window of a steady hand is as
/// long as the hand has been steady.
///
/// Source: Janabi-Sharifi, Hayward & Chen 2000, first-order adaptive windowing, end-fit.
///
/// Departures from the paper
///  - Rest. If all samples of the full window lie within `noise` of each other, their line is noise too, and a tool at rest
///    would creep by up to q / (n T). The velocity is then 0, unless they lie on a line to within 1e-6 of its rise: a true
///    ramp is exact, however slow. So the resolution is noise / (max_window T), as in the paper.
///  - `noise` 0 means the quantum of the device. No wire carries the quantum, so the node takes the smallest step it has seen, per
///    axis. For quantised positions this is the quantum, once the tool has moved slowly. For exact positions it is the step of the
///    slowest moment so far, and the window soon shrinks to a tick or two. Steps below 1e-10 m are rounding.
///
/// Good to know
///  - If the noise is not in steps, or the steps are rotated out of their axes, set `noise`: the largest distance between two
///    samples of a tool at rest. The value learnt by the node would be too small.
///  - Exact on ramps, from the second sample if its steps exceed the noise, else from the third. With quantised positions the
///    error is below 2 noise / (n T). The lag is n T / 2: under an acceleration a, n T is about sqrt (8 noise / a). So the node
///    helps most where the hand is slow; with `noise` set too large it lags.
///  - `window`, in seconds, gives the same resolution at every tick rate. With `max_window`, in ticks, ten times the tick rate
///    makes the error from the quantum ten times larger. The window is at most 256 ticks long: 12.8 ms at 20 kHz.
///  - The cost grows with the number of ticks in the window.
///  - It is 0 on the first sample and after a fault. The learnt quantum stays.
struct Velocity
{
    struct Inputs
    {
        Position position = Position::Zero();
    };

    struct Params
    {
        double noise = 0.0;
    };

    struct Settings
    {
        int max_window = 16;
        double window = 0.0;
    };

    struct Outputs
    {
        Vec3 velocity = Vec3::Zero();
        double speed = 0.0;
    };

    static constexpr Info info {
        .id = "motion.velocity",
        .name = "Velocity",
        .summary = "Velocity from quantised positions, over a window that adapts to the motion.",
        .source = "Janabi-Sharifi, Hayward & Chen 2000",
        .keywords = "speed derivative differentiate",
    };

    static constexpr int longest_window = 256;

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        param (&Params::noise, "noise", unit::metre, "distance between samples at rest; 0: the learnt quantum", { .hard = { 0, inf }, .usual = { 0, 1e-3 } }),
        setting (&Settings::max_window, "max_window", unit::count, "longest window, in ticks", { .hard = { 1, longest_window }, .usual = { 1, 64 } }),
        setting (&Settings::window, "window", unit::second, "longest window, in seconds; 0: max_window", { .hard = { 0, inf }, .usual = { 0, 0.02 } }),
        output (&Outputs::velocity, "velocity", unit::speed, "velocity of the tool"),
        output (&Outputs::speed, "speed", unit::speed, "magnitude of the velocity"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        const double ticks = settings.window > 0.0 ? std::round (settings.window / dt) : settings.max_window;
        longest = static_cast<int> (std::clamp (ticks, 1.0, static_cast<double> (longest_window)));
        axes = {};
        known = 0;
    }

    void adopt (const Velocity& old) noexcept
    {
        axes = old.axes;
        newest = old.newest;
        known = old.known;
    }

    Outputs tick (const Inputs& in) noexcept
    {
        if (! isFinite (in.position))
        {
            known = 0;
            return {};
        }

        newest = newest + 1 < capacity ? newest + 1 : 0;
        known = std::min (known + 1, capacity);
        Vec3 v;
        for (int i = 0; i < 3; ++i)
        {
            Axis& axis = axes[at (i)];
            axis.past[at (newest)] = in.position[i];
            learn (axis);
            axis.still = isSame (ago (axis, 0), ago (axis, 1)) ? std::min (axis.still + 1, capacity) : 0;
            v[i] = slope (axis) / dt;
        }

        const Outputs out { .velocity = v, .speed = length (v) };
        if (! isFinite (out.velocity, out.speed))
        {
            known = 0;
            return {};
        }
        return out;
    }

    void serialize (auto& archive)
    {
        archive (axes);
        archive.index (newest, capacity);
        archive.index (known, capacity + 1);
    }

private:
    static constexpr int capacity = longest_window + 1;
    static constexpr double rounding = 1e-10;   // m; no encoder is finer

    static constexpr auto inverses = []   // 1/n; a multiplication costs a fifth of a division
    {
        std::array<double, capacity> all {};
        for (int n = 1; n < capacity; ++n)
            all[at (n)] = 1.0 / n;
        return all;
    }();

    struct Axis
    {
        std::array<Fine, capacity> past {};   // ring of the last positions, in m
        double quantum = inf;                 // smallest step seen, m
        int still = 0;                        // how many positions before the newest one have the same bits, up to the capacity
    };

    Fine ago (const Axis& axis, int ticks) const noexcept
    {
        const int place = newest - ticks;
        return axis.past[at (place >= 0 ? place : place + capacity)];
    }

    /// Compares bits, because the difference of 0 and -0 has a sign.
    static bool isSame (Fine a, Fine b) noexcept { return std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b); }

    void learn (Axis& axis) const noexcept
    {
        if (known < 2) return;
        const double step = std::abs (ago (axis, 0) - ago (axis, 1));
        if (step > rounding) axis.quantum = std::min (axis.quantum, step);
    }

    /// End-fit slope over the longest window that fits, in m per tick.
    double slope (const Axis& axis) const noexcept
    {
        const int reach = std::min (longest, known - 1);
        if (reach < 1 || axis.still >= reach) return 0.0;

        const bool is_set = params.noise > 0.0;
        const double learnt = axis.quantum < inf ? axis.quantum : 0.0;
        const double noise = (is_set ? params.noise : learnt) * (1.0 + margin (1e-6));   // computed quanta differ in the last bits
        const Fine now = ago (axis, 0);

        // The range of slopes with which a line from now into the past passes within the noise of every sample so far, and the range
        // of these samples.
        double least = -inf, most = inf, lowest = now, highest = now;
        int fitting = 0;
        auto place = at (newest);
        for (int n = 1; n <= reach && least <= most; ++n)
        {
            place = place > 0 ? place - 1 : at (capacity - 1);
            const double then = axis.past[place], inverse = inverses[at (n)], step = (now - then) * inverse, play = noise * inverse;
            if (step >= least && step <= most) fitting = n;
            least = std::max (least, step - play);
            most = std::min (most, step + play);
            lowest = std::min (lowest, then);
            highest = std::max (highest, then);
        }

        const bool rests = least <= most && highest - lowest <= noise && (is_set || reach > 1);
        if (fitting == 0 || (rests && ! isRamp (axis, reach))) return 0.0;
        return (now - ago (axis, fitting)) / fitting;
    }

    /// True if the samples of a window lie on a line.
    bool isRamp (const Axis& axis, int n) const noexcept
    {
        const Fine now = ago (axis, 0);
        const double rise = now - ago (axis, n);
        if (n < 2) return false;
        for (int i = 1; i < n; ++i)
            if (! (std::abs (now - rise * i / n - ago (axis, i)) <= margin (1e-6) * std::abs (rise))) return false;
        return true;
    }

    std::array<Axis, 3> axes;
    int newest = 0, known = 0;
    int longest = 16;                     // ticks
    double dt = 1.0 / Setup {}.rate_hz;   // s
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Velocity);
