// SPDX-License-Identifier: MIT
#pragma once

#include "device.hpp"

#include <algorithm>
#include <cmath>

namespace tactus
{

/// Keeps what is on a device from stepping when another plan takes over. What is asked for becomes
///
///     e + (e0 - e1) w(t)        w = (1 + cos (pi t / fade_s)) / 2 for 0 <= t <= fade_s, then 0
///
/// with e0 the last effort before, and e1 the first one after. So the first one is e0 again, and from there on a tick
/// adds to the steps of e at most |e0 - e1| pi T / (2 fade_s). The nodes are not ticked twice, as a crossfade would.
class Bumpless
{
public:
    static constexpr double fade_s = 0.010;

    void prepare (double dt_s) noexcept { length = std::max (1, static_cast<int> (std::lround (fade_s / dt_s))); }   // [main thread]

    void begin() noexcept { now = 0; }   // [tick thread]

    Effort operator() (const Effort& wanted) noexcept   // [tick thread]
    {
        if (now == length) return last = wanted;
        if (now == 0)
        {
            difference = { last.force - wanted.force, last.torque - wanted.torque, sum (last.axes, -1.0, wanted.axes), sum (last.signals, -1.0, wanted.signals) };
            if (! isFinite (difference.force, difference.torque, difference.axes, difference.signals))
            {
                now = length;
                return last = wanted;
            }
        }
        const double w = 0.5 + 0.5 * std::cos (pi * now / length);
        ++now;
        last = { wanted.force + w * difference.force, wanted.torque + w * difference.torque, sum (wanted.axes, w, difference.axes), sum (wanted.signals, w, difference.signals) };
        return last;
    }

    /// The guard has something else on the device: nothing is left to be faded. [tick thread]
    void stop (const Effort& applied) noexcept
    {
        now = length;
        last = applied;
    }

private:
    static constexpr double pi = 3.14159265358979323846;

    /// a + w b
    static Channels sum (const Channels& a, double w, const Channels& b) noexcept
    {
        Channels all;
        for (int i = 0; i < std::max (a.size(), b.size()); ++i)
            all.set (i, a[i] + w * b[i]);
        return all;
    }

    int length = 1, now = length;   // ticks
    Effort difference;              // at the beginning
    Effort last;
};

}   // namespace tactus
