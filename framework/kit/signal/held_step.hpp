// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>

namespace tactus
{

namespace detail
{
/// (h - (1 - e^-h))/h^2, given `loss` = e^-h - 1. The difference loses as many digits as h has leading zeros, so a small h uses the
/// series 1/2! - h/3! + h^2/4! - ...; at h = 1/4, both forms are accurate to the second-to-last digit.
inline double secondOrder (double h, double loss) noexcept
{
    if (h > 0.25) return (h + loss) / (h * h);

    double sum = 0.0;
    for (int n = 14; n >= 2; --n)
        sum = (1.0 - h * sum) / n;
    return sum;
}
}   // namespace detail

/// The motion of a mass M with viscous damping B while the force F is constant for the time T:
///
///     a = e^(-B T/M)     g = M (1 - a)/B
///     x += g v + (T - g)/B F
///     v += (a - 1) v + (1 - a)/B F
struct HeldStep
{
    HeldStep (double mass, double damping, double dt_s) noexcept;

    template <typename T>
    void operator() (T& position, T& velocity, const T& force) const noexcept
    {
        position += x_per_v * velocity + x_per_f * force;
        velocity += v_loss * velocity + v_per_f * force;
    }

    double x_per_v, x_per_f, v_loss, v_per_f;   // g, (T - g)/B, a - 1, (1 - a)/B
};

inline HeldStep::HeldStep (double mass, double damping, double dt_s) noexcept
{
    const double h = damping * dt_s / mass;
    v_loss = h == 0.0 ? 0.0 : math::expm1 (-h);
    const double first = h == 0.0 ? 1.0 : -v_loss / h;   // (1 - e^-h)/h, to the last digits even if h is tiny
    x_per_v = dt_s * first;
    x_per_f = dt_s * dt_s / mass * detail::secondOrder (h, v_loss);
    v_per_f = dt_s / mass * first;
}

}   // namespace tactus
