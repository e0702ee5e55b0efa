// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace tactus::host
{

/// A level meter: the recent RMS level, and the peak of the last seconds. The peak is always one that the signal had: it does not fall slowly.
class Meter
{
public:
    static constexpr double hold_s = 2.0;   ///< the peak is the largest one of this time, and of up to a tenth of a second before

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
        for (part_s += dt_s; part_s >= step_s; part_s -= step_s)
        {
            at = (at + 1) % peaks.size();
            peaks[at] = 0.0;
        }
        peaks[at] = std::max (peaks[at], highest);
    }

    double rms() const noexcept { return level; }
    double peak() const noexcept { return *std::ranges::max_element (peaks); }

private:
    static constexpr double step_s = 0.1;
    std::array<double, 21> peaks {};   // of each tenth of a second
    std::size_t at = 0;
    double level = 0.0, part_s = 0.0;
};

/// The position of a level on a scale of four decades, from 0.001 to 10, as 0 to 1.
inline double meterPosition (double level) noexcept { return level > 0.0 ? std::clamp ((std::log10 (level) + 3.0) / 4.0, 0.0, 1.0) : 0.0; }

}   // namespace tactus::host
