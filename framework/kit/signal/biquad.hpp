// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus
{

/// The cutoffs that a digital filter can have, in Hz: at least a millionth of the sample rate, where rounding begins to swallow
/// the poles, and at most just below half of the sample rate, where nothing is left to cut.
inline double usableCutoff (double cutoff_hz, double rate_hz) noexcept
{
    return std::clamp (cutoff_hz, 1e-6 * rate_hz, 0.4999 * rate_hz);
}

/// tan (pi cutoff / rate): the analogue frequency that the bilinear transform maps to the cutoff.
inline double prewarped (double cutoff_hz, double rate_hz) noexcept
{
    return math::tan (std::numbers::pi * usableCutoff (cutoff_hz, rate_hz) / rate_hz);
}

/// H(z) = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2)
struct Biquad
{
    double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

/// The second-order Butterworth low-pass, discretised by the bilinear transform and prewarped so that the cutoff is exact.
inline Biquad butterworth2 (double cutoff_hz, double rate_hz) noexcept
{
    const double k = prewarped (cutoff_hz, rate_hz);
    const double damped = std::numbers::sqrt2 * k;
    const double norm = 1.0 / (1.0 + damped + k * k);
    const double b = k * k * norm;
    return { b, 2.0 * b, b, 2.0 * (k * k - 1.0) * norm, (1.0 - damped + k * k) * norm };
}

/// The memory of a biquad in transposed direct form II, the form that tolerates moving coefficients best. A sample that the
/// filter cannot process, non-finite or too large, gives 0 and resets the filter.
class BiquadState
{
public:
    static constexpr double silence = 1e-100;   ///< a smaller state becomes 0; far below anything felt, far above the slow denormal numbers

    double operator() (const Biquad& c, double x) noexcept
    {
        const double y = c.b0 * x + s1;
        s1 = c.b1 * x - c.a1 * y + s2;
        s2 = c.b2 * x - c.a2 * y;

        if (! isFinite (y, s1, s2))
        {
            *this = {};
            return 0.0;
        }
        if (std::abs (s1) + std::abs (s2) < silence) *this = {};
        return y;
    }

private:
    double s1 = 0.0, s2 = 0.0;
};

}   // namespace tactus
