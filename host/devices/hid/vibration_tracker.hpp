// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace tactus::host::hid
{

/// Tracks the amplitude and the frequency of a signal, for motors that take only these two.
///
///     amplitude   the largest |signal| over the most recent time, at least `hold` and at most twice `hold` long
///     frequency   1/(time between the last two rising zero crossings, interpolated between ticks); 0 if there were none for 0.1 s
///
/// For a mixture of tones, the result may not be the frequency of any of them.
class VibrationTracker
{
public:
    void prepare (double dt_s, double hold_s) noexcept
    {
        *this = {};
        dt = dt_s;
        hold = std::max (1, static_cast<int> (std::ceil (hold_s / dt_s)));
    }

    void tick (double signal) noexcept
    {
        newest = std::max (newest, std::abs (signal));
        if (++counted >= hold)
        {
            older = newest;
            newest = 0.0;
            counted = 0;
        }

        since += dt;
        if (last < 0.0 && signal >= 0.0)
        {
            const double after = dt * signal / (signal - last);   // time from the zero crossing until now, in s
            const double period = since - after;
            hertz = period > 0.0 && period <= longest_period && has_zero ? 1.0 / period : 0.0;
            since = after;
            has_zero = true;
        }
        if (since > longest_period)
        {
            hertz = 0.0;
            has_zero = false;
        }
        last = signal;
    }

    /// From now on, only later samples count for the amplitude. Called on each tick of a stop, so that the amplitude falls as the signal
    /// does, instead of `hold` later.
    void forgetPeaks() noexcept
    {
        older = newest = 0.0;
        counted = 0;
    }

    double amplitude() const noexcept { return std::max (older, newest); }
    double frequency() const noexcept { return hertz; }   ///< Hz

private:
    static constexpr double longest_period = 0.1;   // s

    double dt = 1e-3;
    int hold = 1, counted = 0;   // ticks
    double newest = 0.0, older = 0.0;
    double last = 0.0, since = 0.0, hertz = 0.0;
    bool has_zero = false;
};

}   // namespace tactus::host::hid
