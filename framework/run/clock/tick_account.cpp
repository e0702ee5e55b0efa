// SPDX-License-Identifier: MIT
#include "tick_account.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tactus
{

namespace
{
constexpr int mantissa_bits = 52, piece_bits = 4;

/// The octave from 1 to 2, cut into 16 pieces of equal width. A piece contains at most one of the bounds 2^(k/8), because these are more than
/// 1/16 apart.
struct Piece
{
    std::uint64_t below;   ///< number of bounds below the piece
    std::uint64_t bound;   ///< mantissa of the bound in the piece, or one that none exceeds
};

constexpr auto pieces = [] {
    constexpr double bounds[] { 1.0, 1.0905077326652577, 1.1892071150027211, 1.2968395546510096,   // 2^(k/8)
                                1.4142135623730951, 1.5422108254079408, 1.6817928305074290, 1.8340080864093424 };
    constexpr std::uint64_t mask = (std::uint64_t { 1 } << mantissa_bits) - 1;
    std::array<Piece, 1 << piece_bits> all {};
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const double begin = 1.0 + static_cast<double> (i) / all.size(), end = begin + 1.0 / all.size();
        all[i].bound = mask;
        for (const double bound : bounds)
            if (bound < begin)
                ++all[i].below;
            else if (bound < end)
                all[i].bound = std::bit_cast<std::uint64_t> (bound) & mask;
    }
    return all;
}();

/// 8 log2 x, rounded up, for x from 1 up. Several times faster than std::log2, which a tick would call twice.
std::size_t eighthsOfOctaves (double x) noexcept
{
    const auto bits = std::bit_cast<std::uint64_t> (x);
    const auto octaves = (bits >> mantissa_bits) - 1023;
    const auto mantissa = bits & ((std::uint64_t { 1 } << mantissa_bits) - 1);
    const auto& piece = pieces[mantissa >> (mantissa_bits - piece_bits)];
    return 8 * octaves + piece.below + (mantissa > piece.bound ? 1 : 0);
}

/// Adds to a counter. Only one thread writes, so an addition need not be atomic as a whole.
template <typename T>
void add (std::atomic<T>& to, T n) noexcept
{
    to.store (to.load (std::memory_order_relaxed) + n, std::memory_order_relaxed);
}
}   // namespace

void Durations::note (double s) noexcept
{
    static_assert (per_octave == 8);
    add (counts[std::min (bins - 1, s > shortest ? eighthsOfOctaves (s / shortest) : 0)], std::uint64_t { 1 });
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

/// Everything that it calls is inlined, because it runs on every tick.
[[gnu::flatten]] void TickAccount::note (double late_s, double took_s) noexcept
{
    late.note (late_s);
    took.note (took_s);
    add (count, std::uint64_t { 1 });
    if (late_s > period) add (missed, std::uint64_t { 1 });
    overrun_s = took_s > period ? overrun_s + took_s : 0.0;
}

}   // namespace tactus
