// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::host::audio
{

/// The last stage before a channel of the card: keeps the sum of everything that plays on the channel within the strictest limits
/// of the roles that drive it. The guard of a role cannot do this, because it acts before the gain, the filter, the sum and the
/// resampler. Without a limit, samples pass through bit for bit.
class ChannelLimit
{
public:
    /// Adds the limits of a role: the largest sample value (1 is full scale), and how much it may change per s. [main thread, while no block is requested]
    void tighten (double most_sample, double slew_per_s) noexcept
    {
        is_set = true;
        most = std::min (most, notAbove (most_sample));
        slew = std::min (slew, slew_per_s);
    }

    bool isSet() const noexcept { return is_set; }

    /// The longest time that a channel can take to reach zero, in s.
    double fall() const noexcept { return ! is_set || most == 0.0 ? 0.0 : most / slew; }

    /// Call when a card starts, whose channels are silent. [main thread, while no block is requested]
    void restart() noexcept { last = 0.0; }

    /// Limits samples from -1 to 1. A sample that is not a number counts as 0. `period_s`: the time for which the card plays a sample, in s.
    /// [audio thread]
    void operator() (float* samples, int frames, double period_s) noexcept
    {
        if (! is_set) return;
        const double step = slew == std::numeric_limits<double>::infinity() ? slew : slew * period_s;
        for (int i = 0; i < frames; ++i)
        {
            const double sample = static_cast<double> (samples[i]), wanted = isFinite (sample) ? std::clamp (sample, -most, most) : 0.0;
            const double change = wanted - last;
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

    bool is_set = false;
    double most = 1.0, slew = std::numeric_limits<double>::infinity();
    double last = 0.0;   // not rounded to float: a step below the resolution of a float must still add up   [audio thread]
};

}   // namespace tactus::host::audio
