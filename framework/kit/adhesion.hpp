// SPDX-License-Identifier: MIT
#pragma once

#include "curve.hpp"
#include "vec3.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus
{

/// How a stretched contact yields: the adhesion functions of Fig. 2 of the chapter. All lengths are in units of d_max, the stretch
/// at which the contact slides, so that one function serves contacts whose d_max changes.
///
///     stick    0 up to d_stick, then 1
///     dupont   0 up to d_ba, a half sine, 1 from d_stick on (Dupont et al. 2002)
///     ramp     r / d_stick, at most 1
///     dahl     1
///     curve    a table, each value limited to 0…1
struct Adhesion
{
    enum class Kind
    {
        stick,
        dupont,
        ramp,
        dahl,
        curve
    };

    Kind kind = Kind::stick;
    double d_stick = 1.0, d_ba = 0.7;
    const Curve* table = nullptr;

    /// zeta d_max at a stretch r = |d| / d_max. [any thread]
    double operator() (double r) const noexcept;

    /// The stretch after a step, given the stretch d before it and the stretch d + dp that it would be without slip; everything in m.
    /// Without slip the result is this one, to the bit. Eq. (3) for `stick`. With d_stick above 1, `stick` holds up to d_stick
    /// and falls back to d_max; what a step pulls beyond a whole number of such falls stays in the stretch, so that the period of
    /// the slips does not depend on the speed. For the others, the solution of eq. (2) with zeta held over the step. A d_max
    /// of 0 holds nothing. [any thread]
    Vec3 stretch (const Vec3& d, const Vec3& pulled, double d_max) const noexcept;
};

//==============================================================================
// Implementation below.

inline double Adhesion::operator() (double r) const noexcept
{
    switch (kind)
    {
    case Kind::stick:
        return r > d_stick ? 1.0 : 0.0;
    case Kind::dupont:
        if (r >= d_stick) return 1.0;
        if (r <= d_ba) return 0.0;
        return 0.5 * (1.0 + std::sin (std::numbers::pi * (r - 0.5 * (d_stick + d_ba)) / (d_stick - d_ba)));
    case Kind::ramp:
        return std::min (r / d_stick, 1.0);
    case Kind::dahl:
        return 1.0;
    case Kind::curve:
        return table ? std::clamp ((*table) (r), 0.0, 1.0) : 0.0;
    }
    return 0.0;
}

inline Vec3 Adhesion::stretch (const Vec3& d, const Vec3& pulled, double d_max) const noexcept
{
    constexpr double guard = 1e-9;   // relative; keeps steady sliding away from the point where the branches meet
    if (! (d_max > 0.0)) return Vec3::Zero();

    const double r = pulled.norm() / d_max;
    if (kind == Kind::stick)
    {
        if (! (r > d_stick * (1.0 + guard))) return pulled;
        const double fall = d_stick - 1.0;
        return pulled * ((fall > guard ? 1.0 + std::fmod (r - d_stick, fall) : 1.0) / r);
    }

    // If d_max has shrunk below the stretch, the contact first lets go.
    const double held = (*this) (d.norm() / d_max) * d.norm() / d_max;
    const bool lets_go = held > 1.0 + guard;
    const Vec3 dp = pulled - d, before = lets_go ? Vec3 { d / held } : d, after = lets_go ? Vec3 { before + dp } : pulled;
    const double x = (*this) (after.norm() / d_max) * dp.norm() / d_max;
    if (! (x > 0.0)) return after;
    return std::exp (-x) * before - std::expm1 (-x) / x * dp;
}

}   // namespace tactus
