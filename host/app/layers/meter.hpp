// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace tactus::host
{

/// A level meter: the recent RMS level, and the peak, which is held for a while. The peak is always one that the signal had: it does not fall slowly.
class Meter
{
public:
    static constexpr double hold_s = 2.0;   ///< the peak is held for this long, then the present one takes its place

    /// Takes the latest samples, the last `fresh` of which are new, and the time since the last call.
    void take (std::span<const double> latest, std::size_t fresh, double dt_s) noexcept
    {
        double sum = 0.0, highest = 0.0;
        std::size_t n = 0;
        for (std::size_t i = 0; i < latest.size(); ++i)
        {
            const double v = latest[i];
            if (! std::isfinite (v)) continue;
            sum += v * v;
            ++n;
            if (i + fresh >= latest.size()) highest = std::max (highest, std::abs (v));
        }
        level = n > 0 ? std::sqrt (sum / static_cast<double> (n)) : 0.0;
        held_for += dt_s;
        if (highest >= held || held_for > hold_s)
        {
            held = highest;
            held_for = 0.0;
        }
    }

    double rms() const noexcept { return level; }
    double peak() const noexcept { return held; }

private:
    double level = 0.0, held = 0.0, held_for = 0.0;
};

/// The position of a level on a scale of four decades, from 0.001 to 10, as 0 to 1.
inline double meterPosition (double level) noexcept { return level > 0.0 ? std::clamp ((std::log10 (level) + 3.0) / 4.0, 0.0, 1.0) : 0.0; }

}   // namespace tactus::host
