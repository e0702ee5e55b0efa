// SPDX-License-Identifier: MIT
#pragma once

#include "curve.hpp"
#include "math/math.hpp"
#include "vec3.hpp"

#include <algorithm>
#include <numbers>

namespace tactus
{

enum class BristleAdhesion
{
    stick,
    dupont,
    ramp,
    dahl,
    curve
};

enum class BristleIntegrator
{
    exponential,
    euler
};

/// The bristle between a tool and its contact point: how it stretches, yields and slips when the tool moves. Time-free.
///
/// All lengths are in m. The force is the stretch times a stiffness sigma. The caller sets sigma and handles its changes.
/// The equations are those of Hayward, "Physically-Based Haptic Synthesis" (2007), section 2.
struct Bristle
{
    using Adhesion = BristleAdhesion;
    using Integrator = BristleIntegrator;

    /// One step: the new stretch, the energy lost in the step divided by sigma (m²), and whether the contact point has moved.
    struct Step
    {
        Vec3 d;
        double loss = 0.0;
        bool slips = false;
    };

    Adhesion adhesion {};
    Integrator integrator {};
    double d_max = 1e-4;          ///< stretch while sliding; above 0
    double d_stick = 1e-4;        ///< stretch that function 1 holds before it slips; at least d_max
    double d_ba = 0.7e-4;         ///< stretch at which `dupont` begins to yield
    const Curve* own = nullptr;   ///< zeta d_max over |d| / d_max, for `curve`

    /// Fig. 2: how fast the bristle yields at a stretch of length r, in 1/m.
    double zeta (double r) const noexcept;

    /// Moves the tool by dp, in a straight line.
    Step stretch (const Vec3& d, const Vec3& dp) const noexcept;

    /// If d_max or d_stick has become too small for the stretch, shortens the stretch to the length at which the contact slides.
    /// Only the exponential form needs this: with eq. (3) and (4), the next call to `stretch` does it. Returns true if the stretch
    /// has changed.
    bool letGo (Vec3& d) const noexcept;

    /// Without `own`, which its owner sets before each use.
    void serialize (auto& archive) { archive (adhesion, integrator, d_max, d_stick, d_ba); }

private:
    static constexpr double eps_slip = margin (1e-9);   // relative; keeps steady sliding away from the branch points of eq. (3) and (4)

    Step stick (const Vec3& d, const Vec3& dp) const noexcept;
    Step euler (const Vec3& d, const Vec3& dp) const noexcept;
    Step exponential (const Vec3& d, const Vec3& dp) const noexcept;
    Step drag (double from, const Vec3& d, double r, double hold) const noexcept;
    double afterSlip (double r) const noexcept;
};

//==============================================================================
// Implementation below.

inline auto Bristle::stretch (const Vec3& d, const Vec3& dp) const noexcept -> Step
{
    if (adhesion == Adhesion::stick) return stick (d, dp);
    return integrator == Integrator::exponential ? exponential (d, dp) : euler (d, dp);
}

inline double Bristle::zeta (double r) const noexcept
{
    switch (adhesion)
    {
    case Adhesion::stick:
        return r > d_stick ? 1.0 / d_max : 0.0;
    case Adhesion::dupont:
        if (r >= d_stick) return 1.0 / d_max;
        if (r <= d_ba) return 0.0;
        return 0.5 / d_max * (1.0 + math::sin (std::numbers::pi * (r - 0.5 * (d_stick + d_ba)) / (d_stick - d_ba)));
    case Adhesion::ramp:
        return std::min (r / d_stick, 1.0) / d_max;
    case Adhesion::dahl:
        return 1.0 / d_max;
    case Adhesion::curve:
        return own ? std::clamp ((*own) (r / d_max), 0.0, 1.0) / d_max : 0.0;
    }
    return 0.0;
}

/// Eq. (3): d = d~ min (1, d_max / |d~|), with d~ = d + dp. Slips only beyond d_stick.
inline auto Bristle::stick (const Vec3& d, const Vec3& dp) const noexcept -> Step
{
    const Vec3 pulled = d + dp;
    const double r = pulled.norm();
    if (r > d_stick * (1.0 + eps_slip)) return drag (d.norm(), pulled, r, d_stick);
    return { .d = pulled };
}

/// Eq. (4): d = d~ - |dp| zeta (|d~|) d~, with |dp| zeta clamped at 1. For the loss, the bristle first stretches to d~ and then yields there.
inline auto Bristle::euler (const Vec3& d, const Vec3& dp) const noexcept -> Step
{
    const Vec3 pulled = d + dp;
    const double r = pulled.norm(), z = zeta (r);
    if (z * r > 1.0 + eps_slip) return drag (d.norm(), pulled, r, 1.0 / z);

    const double g = std::min (1.0, z * dp.norm());
    return { .d = pulled - g * pulled, .loss = 0.5 * g * (2.0 - g) * r * r, .slips = g > 0.0 };
}

/// Eq. (2), solved with zeta held over the step, x = zeta |dp|. The mean stretch over the step is phi d + psi dp; its product
/// with dp is the work done in the step.
inline auto Bristle::exponential (const Vec3& d, const Vec3& dp) const noexcept -> Step
{
    const double x = zeta ((d + dp).norm()) * dp.norm();
    if (! (x > 0.0)) return { .d = d + dp };

    const double gone = -math::expm1 (-x), phi = gone / x;
    const double psi = x < 1e-3 ? 1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0)) : (1.0 - phi) / x;
    const Vec3 after = (1.0 - gone) * d + phi * dp;
    const double work = (phi * d + psi * dp).dot (dp);
    return { .d = after, .loss = std::max (0.0, work - 0.5 * (after - d).dot (after + d)), .slips = true };
}

/// Drags the contact point along: the stretch grows from the length `from` to d (of length r) and slips. The contact holds up to a
/// stretch of `hold`, or up to `from` if that is longer because the bound has shrunk. At this stretch, the spring collapses for
/// the first time. From then on, the contact slips against the mean of static and sliding friction; with stick-slip, this is one
/// collapse after another.
inline auto Bristle::drag (double from, const Vec3& d, double r, double hold) const noexcept -> Step
{
    const double peak = std::clamp (from, hold, r), fallen = afterSlip (peak), after = afterSlip (r);
    const double rest = (r - after) - (peak - fallen);
    return { .d = d * (after / r), .loss = 0.5 * ((peak - fallen) * (peak + fallen) + (hold + d_max) * rest), .slips = true };
}

/// The length to which a stretch slips back after a pull to r, beyond the bound. Function 1 with d_stick above d_max collapses
/// to d_max each time the stretch reaches d_stick. A large step contains several collapses, and leaves the stretch that a slow
/// hand would have built up since the last one.
inline double Bristle::afterSlip (double r) const noexcept
{
    const double gap = d_stick - d_max;
    if (adhesion != Adhesion::stick || ! (gap > d_max * eps_slip)) return d_max;
    return d_max + math::fmod (r > d_stick ? r - d_stick : 0.0, gap);
}

inline bool Bristle::letGo (Vec3& d) const noexcept
{
    if (adhesion == Adhesion::stick || integrator == Integrator::euler) return false;
    const double r = d.norm(), yield = zeta (r) * r;
    if (! (yield > 1.0 + eps_slip)) return false;
    d /= yield;
    return true;
}

}   // namespace tactus
