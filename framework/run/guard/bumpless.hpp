// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/device.hpp>

#include <algorithm>
#include <cmath>

namespace tactus
{

/// Keeps the effort on a device free of steps when another plan takes over. The wanted effort e becomes
///
///     e + (e0 - e1) w(t)        w = (1 + cos (pi t / fade_s)) / 2 for 0 <= t <= fade_s, then 0
///
/// where e0 is the last effort before the switch and e1 the first one after it. So the first effort is e0 again, and each tick
/// adds at most |e0 - e1| pi T / (2 fade_s) to the steps of e. Unlike a crossfade, this does not tick the nodes twice.
class Bumpless
{
public:
    static constexpr double fade_s = 0.010;

    void prepare (double dt_s) noexcept { now = length = std::max (1, static_cast<int> (std::lround (fade_s / dt_s))); }   // [main thread]

    void begin() noexcept { now = 0; }   // [tick thread]

    const Effort& operator() (const Effort& wanted) noexcept   // [tick thread]
    {
        return now == length ? last = wanted : fade (wanted);
    }

    /// The guard has applied a different effort to the device, so there is nothing left to fade. [tick thread]
    void stop (const Effort& applied) noexcept
    {
        now = length;
        last = applied;
    }

    void serialize (auto& archive)
    {
        archive (difference, last);
        archive.index (now, static_cast<std::size_t> (length) + 1);
    }

private:
    static constexpr double pi = 3.14159265358979323846;

    const Effort& fade (const Effort& wanted) noexcept
    {
        if (now == 0)
        {
            difference = { last.force - wanted.force, last.torque - wanted.torque, sum (last.axes, -1.0, wanted.axes),
                           sum (last.signals, -1.0, wanted.signals), last.brake - wanted.brake };
            if (! isFinite (difference.force, difference.torque, difference.axes, difference.signals, difference.brake))
            {
                now = length;
                return last = wanted;
            }
            ++now;
            return last;   // no step at all: wanted + (last - wanted) would round
        }
        const double w = 0.5 + 0.5 * math::cos (pi * now / length);
        ++now;
        last = { wanted.force + w * difference.force, wanted.torque + w * difference.torque, sum (wanted.axes, w, difference.axes),
                 sum (wanted.signals, w, difference.signals), wanted.brake + w * difference.brake };
        return last;
    }

    /// a + w b
    static Channels sum (const Channels& a, double w, const Channels& b) noexcept
    {
        Channels all;
        for (int i = 0; i < std::max (a.size(), b.size()); ++i)
            all.set (i, a[i] + w * b[i]);
        return all;
    }

    int length = 1, now = length;   // duration of the fade, and time since it began, in ticks; equal if there is no fade
    Effort difference;              // e0 - e1
    Effort last;
};

}   // namespace tactus
