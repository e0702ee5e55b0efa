// SPDX-License-Identifier: MIT
#include "rate_meter.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{

void RateMeter::add (double time_s, std::uint64_t count) noexcept
{
    if (looks == 0)
    {
        first_time = time_s;
        first_count = count;
    }
    const double t = time_s - first_time;
    const double n = static_cast<double> (static_cast<std::int64_t> (count - first_count));
    if (! (t >= newest)) return;   // the clocks that we use never go backwards

    // Updates the sums by recurrence (Welford 1962), so that no digits are lost over a long run.
    ++looks;
    newest = t;
    const double share = 1.0 / static_cast<double> (looks);
    const double dt = t - mean_t, dn = n - mean_n;
    mean_t += share * dt;
    mean_n += share * dn;
    tt += dt * (t - mean_t);
    tn += dt * (n - mean_n);
    nn += dn * (n - mean_n);
}

std::optional<RateMeter::Rate> RateMeter::rate() const noexcept
{
    if (looks < 3 || ! (tt > 0.0)) return std::nullopt;
    const double hz = tn / tt;
    const double about = std::max (0.0, nn - hz * tn);
    return Rate { hz, std::sqrt (about / static_cast<double> (looks - 2) / tt) };
}

}   // namespace tactus::host
