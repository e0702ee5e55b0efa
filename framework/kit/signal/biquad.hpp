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

/// A second-order filter that stays stable however fast its coefficients move: a state variable filter whose two integrators use the trapezoidal
/// rule. With g = prewarped (cutoff) and k = 1/q, it is the bilinear transform of
///
///     H(s) = direct + (band s + low) / (s^2 + k s + 1)
///
/// Source: V. Zavalishin, The Art of VA Filter Design (2012), ch. 3-5.
struct StateVariable
{
    double g = 1.0, k = 1.0;
    double direct = 1.0, band = 0.0, low = 0.0;
    double share = 1.0 / 3.0;   ///< 1 / (1 + g (g + k))
};

/// The coefficients for g = prewarped (cutoff) and k = 1/q.
inline StateVariable stateVariable (double g, double k, double direct, double band, double low) noexcept
{
    return { g, k, direct, band, low, 1.0 / (1.0 + g * (g + k)) };
}

/// The second-order Butterworth low-pass, prewarped so that the cutoff is exact.
inline StateVariable movingButterworth2 (double cutoff_hz, double rate_hz) noexcept
{
    return stateVariable (prewarped (cutoff_hz, rate_hz), std::numbers::sqrt2, 0.0, 0.0, 1.0);
}

/// The memory of a state variable filter. A sample that the filter cannot process, non-finite or too large, gives 0 and resets the filter.
///
/// It keeps the two outputs of the analogue filter, b (band) and l (low), and steps them by the implicit midpoint rule:
///
///     b' = b + g (h + h'),  l' = l + g (b + b'),  h = x - k b - l
///
/// Without input, b^2 + l^2 never grows, whatever g and k > 0 are on each tick: its change is -g k (b + b')^2. Near half the rate, and with a
/// large damping g k, that rule swaps the sign of an error on each tick and hardly makes it smaller. A jump of g or k to there would leave the
/// filter ringing, and the next jump would add to it. So on the tick of such a jump, the step is the backward Euler rule. It removes the error at
/// once, and its energy does not grow either. Source: Rannacher 1984 (backward steps after jumps).
class StateVariableState
{
public:
    static constexpr double silence = 1e-100;   ///< a smaller state becomes 0; far below anything felt, far above the slow denormal numbers

    double operator() (const StateVariable& c, double input) noexcept
    {
        constexpr double highest = 6.3, stiffest = 2.0;   // g at 0.45 of the rate; g k
        const bool jumps = (c.g != g || c.k != k) && g > 0.0 && (c.g > highest || c.g * c.k > stiffest);
        if (jumps)
        {
            const double twice = 2.0 * c.g;
            b = (b + twice * (input - l)) / (1.0 + twice * (c.k + twice));
            l += twice * b;
        }
        else
        {
            const double h = x - c.k * b - l, last = b;
            b = c.share * (last + c.g * (h + input - l - c.g * last));
            l += c.g * (last + b);
        }
        x = input;
        g = c.g;
        k = c.k;
        const double y = c.direct * x + c.band * b + c.low * l;

        if (! isFinite (y, b, l))
        {
            *this = {};
            return 0.0;
        }
        if (std::abs (b) + std::abs (l) + std::abs (x) < silence) *this = {};
        return y;
    }

    void serialize (auto& archive) { archive (b, l, x, g, k); }

private:
    double b = 0.0, l = 0.0, x = 0.0;   // x: the last input
    double g = 0.0, k = 0.0;            // of the last sample; 0: there was none
};

/// The coefficients of H(z) = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2), which stand still. A filter whose coefficients move needs a
/// StateVariable.
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
