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

/// A second-order filter that stays stable while its coefficients move, however fast: a state variable filter, whose two integrators use
/// the trapezoidal rule. With g = prewarped (cutoff) and k = 1/q, it is the bilinear transform of
///
///     H(s) = direct + (band s + low) / (s^2 + k s + 1)
///
/// Its state is that of the analogue filter, whose energy no change of g or k > 0 can raise: without input, s1^2 + s2^2 never grows. So
/// its output stays near that of a filter whose cutoff stands still. Source: V. Zavalishin, The Art of VA Filter Design (2012), ch. 3-5.
struct StateVariable
{
    double a1 = 1.0, a2 = 0.0, a3 = 0.0;   ///< 1 / (1 + g (g + k)), g a1, g a2
    double direct = 1.0, band = 0.0, low = 0.0;
};

/// The coefficients for g = prewarped (cutoff) and k = 1/q.
inline StateVariable stateVariable (double g, double k, double direct, double band, double low) noexcept
{
    const double a1 = 1.0 / (1.0 + g * (g + k));
    return { a1, g * a1, g * g * a1, direct, band, low };
}

/// The second-order Butterworth low-pass, prewarped so that the cutoff is exact.
inline StateVariable movingButterworth2 (double cutoff_hz, double rate_hz) noexcept
{
    return stateVariable (prewarped (cutoff_hz, rate_hz), std::numbers::sqrt2, 0.0, 0.0, 1.0);
}

/// The memory of a state variable filter. A sample that the filter cannot process, non-finite or too large, gives 0 and resets the filter.
class StateVariableState
{
public:
    static constexpr double silence = 1e-100;   ///< a smaller state becomes 0; far below anything felt, far above the slow denormal numbers

    double operator() (const StateVariable& c, double x) noexcept
    {
        const double rest = x - s2;
        const double band = c.a1 * s1 + c.a2 * rest;
        const double low = s2 + c.a2 * s1 + c.a3 * rest;
        const double y = c.direct * x + c.band * band + c.low * low;
        s1 = 2.0 * band - s1;
        s2 = 2.0 * low - s2;

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

/// H(z) = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2), for coefficients that stand still. Those that move need a StateVariable.
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

/// The memory of a biquad in transposed direct form II. A sample that the filter cannot process, non-finite or too large, gives 0 and resets
/// the filter. Coefficients that move can make it grow without limit.
class BiquadState
{
public:
    static constexpr double silence = StateVariableState::silence;

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
