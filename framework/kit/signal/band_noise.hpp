// SPDX-License-Identifier: MIT
#pragma once

#include "windowed_sinc.hpp"
#include <tactus/kit/at.hpp>
#include <tactus/kit/random.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace tactus
{

/// Gaussian noise of variance 1 within a band. It is a function of time: readers with different rates get the same noise.
///
///     n (t) = sum_i e_i h (2 b t - i),   e_i ~ N (0, 1)
///
/// b is the width of the band in Hz, and h a windowed sinc with the energy 1. The spectrum is flat up to 0.8 b and 60 dB down from b
/// upwards. So all of the noise is within the band, and every reader that is faster than 2 b gets the variance 1 and the same
/// spectrum. This is true from the first value on.
class BandNoise
{
public:
    static constexpr int reach = 18;               ///< half the width of h, in intervals between random numbers
    static constexpr double largest_gain = 2.25;   ///< upper bound of sum_i |h (2 b t - i)| at any t

    explicit BandNoise (std::uint64_t seed = 1) noexcept : random (seed)
    {
        for (double& e : recent)
            e = random.normal();
    }

    /// Returns the value now, then advances the time by dt. `portion` is 2 b dt, from 0 to 1. [tick thread]
    double operator() (double portion) noexcept
    {
        double sum = 0.0;
        const auto tap = [&] (int i, int place) { sum += recent[at (place)] * betweenEntries (half.data(), std::abs (reach - i - 1 + phase) * steps); };
        for (int i = 0; i < taps - oldest; ++i)
            tap (i, oldest + i);
        for (int i = taps - oldest; i < taps; ++i)
            tap (i, oldest + i - taps);

        phase += portion;
        if (phase < 1.0) return sum;
        phase -= 1.0;
        recent[at (oldest)] = random.normal();
        oldest = (oldest + 1) % taps;
        return sum;
    }

    void serialize (auto& archive)
    {
        archive (random, recent, phase);
        archive.index (oldest, recent.size());
    }

private:
    static constexpr int taps = 2 * reach, steps = 64;   // `steps` entries of h per random number; h is linear in between

    /// One half of h, from its middle outwards.
    static inline const auto half = [] {
        std::array<double, at (reach * steps + 2)> h {};
        double energy = 0.0;
        for (int i = 0; i < reach * steps; ++i)
        {
            const double x = static_cast<double> (i) / steps;
            h[at (i)] = sinc (0.9 * std::numbers::pi * x) * kaiser60 (x / reach);
            energy += (i == 0 ? 1.0 : 2.0) * h[at (i)] * h[at (i)] / steps;
        }
        for (double& v : h)
            v /= std::sqrt (energy);
        return h;
    }();

    Random random;
    std::array<double, at (taps)> recent {};   // ring of the last random numbers
    int oldest = 0;
    double phase = 0.0;   // 0…1, the time since the last new random number
};

}   // namespace tactus
