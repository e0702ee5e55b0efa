// SPDX-License-Identifier: MIT
#include "tick_account.hpp"

#include <algorithm>
#include <cmath>

namespace tactus
{

namespace
{
/// Only one thread writes, so an addition need not be atomic as a whole.
template <typename T>
void add (std::atomic<T>& to, T n) noexcept
{
    to.store (to.load (std::memory_order_relaxed) + n, std::memory_order_relaxed);
}
}   // namespace

void Durations::note (double s) noexcept
{
    const double bin = std::ceil (per_octave * std::log2 (std::max (s, shortest) / shortest));
    add (counts[std::min (bins - 1, static_cast<std::size_t> (bin))], std::uint64_t { 1 });
    if (s > longest()) longest_s.store (s, std::memory_order_relaxed);
}

double Durations::quantile (double part) const noexcept
{
    std::array<std::uint64_t, bins> seen {};
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < bins; ++i)
        total += seen[i] = counts[i].load (std::memory_order_relaxed);

    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < bins; ++i)
    {
        sum += seen[i];
        if (sum > 0 && static_cast<double> (sum) >= part * static_cast<double> (total))
            return std::min (longest(), shortest * std::exp2 (static_cast<double> (i) / per_octave));
    }
    return 0.0;
}

void TickAccount::note (double late_s, double took_s) noexcept
{
    late.note (late_s);
    took.note (took_s);
    add (count, std::uint64_t { 1 });
    if (late_s > period) add (missed, std::uint64_t { 1 });
    overrun_s = took_s > period ? overrun_s + took_s : 0.0;
}

}   // namespace tactus
