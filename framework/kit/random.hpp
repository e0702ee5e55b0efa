// SPDX-License-Identifier: MIT
#pragma once

#include "math/math.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tactus
{

/// Random numbers for the tick. The same seed gives the same numbers on all machines.
///
/// Source: splitmix64 (Steele, Lea & Flood 2014), one 64-bit word of state. Normal numbers: Box & Muller 1958, only the
/// cosine branch, so that all cost the same and none needs a second try.
class Random
{
public:
    static constexpr double largest_normal = 8.6;   ///< sqrt (-2 ln 2^-53), rounded up

    explicit Random (std::uint64_t seed = 1) noexcept : state (seed) {}

    std::uint64_t bits() noexcept
    {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    /// Uniform over (0, 1].
    double uniform() noexcept { return (static_cast<double> (bits() >> 11) + 1.0) * 0x1p-53; }

    /// Mean 0, standard deviation 1.
    double normal() noexcept
    {
        const double radius = std::sqrt (-2.0 * math::log (uniform()));
        return radius * math::cos (2.0 * std::numbers::pi * uniform());
    }

    void serialize (auto& archive) { archive (state); }

private:
    std::uint64_t state;
};

}   // namespace tactus
