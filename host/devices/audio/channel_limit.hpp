// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>
#include <tactus/run/guard.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace tactus::host::audio
{

/// The last stage before a channel of the card: keeps the sum of everything that plays on the channel within the strictest limits
/// of the roles that drive it. The guard of a role cannot do this, because it acts before the gain, the filter, the sum and the
/// resampler. Without a limit, samples pass through bit for bit.
class ChannelLimit
{
public:
    /// Adds the limits of a role: the largest sample value (1 is full scale), and how much it may change per s. While the card plays, what exceeds
    /// them falls as in the guard (Guard::tighten). [main thread]
    void tighten (double most_sample, double slew_per_s) noexcept
    {
        asked_slew.store (std::min (asked_slew.load (std::memory_order_relaxed), slew_per_s), std::memory_order_relaxed);
        asked_most.store (std::min (asked_most.load (std::memory_order_relaxed), notAbove (most_sample)), std::memory_order_release);
    }

    bool isSet() const noexcept { return asked_most.load (std::memory_order_acquire) != GuardLimits::none; }   ///< [any thread]

    /// The longest time that a channel can take to reach zero, in s. [main thread]
    double fall() const noexcept
    {
        const double largest = asked_most.load (std::memory_order_relaxed);
        return ! isSet() || largest == 0.0 ? 0.0 : largest / asked_slew.load (std::memory_order_relaxed);
    }

    /// Forgets the limits. [main thread, while no block is requested]
    void clear() noexcept
    {
        asked_most = asked_slew = GuardLimits::none;
        restart();
    }

    /// Call when a card starts, whose channels are silent. [main thread, while no block is requested]
    void restart() noexcept
    {
        most = {};
        last = 0.0;
    }

    /// Limits samples from -1 to 1. A sample that is not a number counts as 0. `period_s`: the time for which the card plays a sample, in s.
    /// [audio thread]
    void operator() (float* samples, int frames, double period_s) noexcept
    {
        const auto valid = [] (float s) { return std::isfinite (s) ? static_cast<double> (s) : 0.0; };
        if (frames <= 0) return;
        if (! isSet())
        {
            last = valid (samples[frames - 1]);
            return;
        }
        if (const double asked = asked_most.load (std::memory_order_relaxed); asked < most.goal())
            most.tighten (asked, std::abs (last), Guard::fade_s / std::max (period_s, 1e-6));
        for (int i = 0; i < frames; ++i)
        {
            if (most.isFalling()) most.advance (std::abs (last));
            if (most.isReached (std::abs (last)))
                slew = asked_slew.load (std::memory_order_relaxed);
            const double wanted = std::clamp (valid (samples[i]), -most.now(), most.now()), change = wanted - last;
            const double step = slew == GuardLimits::none ? slew : slew * period_s;
            last = std::abs (change) <= step ? wanted : last + std::copysign (step, change);
            samples[i] = static_cast<float> (last);
        }
    }

private:
    /// The nearest float that is not above the limit, so that rounding to float cannot exceed the limit.
    static double notAbove (double limit) noexcept
    {
        const double within = std::clamp (limit, 0.0, 1.0);
        const auto rounded = static_cast<float> (within);
        return static_cast<double> (static_cast<double> (rounded) > within ? std::nextafter (rounded, 0.0f) : rounded);
    }

    std::atomic<double> asked_most = GuardLimits::none, asked_slew = GuardLimits::none;

    // [audio thread]
    FallingLimit most;
    double slew = GuardLimits::none;
    double last = 0.0;   // not rounded to float: a step below the resolution of a float must still add up
};

}   // namespace tactus::host::audio
