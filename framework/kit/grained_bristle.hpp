// SPDX-License-Identifier: MIT
#pragma once

#include "bristle.hpp"
#include "math/math.hpp"

#include <algorithm>
#include <cmath>

namespace tactus
{

/// The stretches at which a contact on a grain slides: two half ellipses with a common half axis across the grain. Convex, without a corner.
/// Vectors are (along, across) the grain. All lengths are in m and above 0.
struct FrictionBound
{
    using Vec2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;

    double with = 1e-4, against = 1e-4, side = 1e-4;   ///< half axes: along +, along - and across

    bool operator== (const FrictionBound&) const = default;

    bool isCircle() const noexcept { return with == side && against == side; }

    /// The half axes of the half in which a vector lies.
    Vec2 axes (const Vec2& d) const noexcept { return { d.x() < 0.0 ? against : with, side }; }

    /// The length of a stretch, in lengths of the bound in its direction: 1 on the bound.
    double share (const Vec2& d) const noexcept { return d.cwiseQuotient (axes (d)).norm(); }

    /// The largest d . v of all stretches d within the bound: while the contact slips by v, it turns this times sigma into heat.
    double support (const Vec2& v) const noexcept { return withNormal (v).dot (v); }

    /// The point of the bound where its outer normal is v.
    Vec2 withNormal (const Vec2& v) const noexcept
    {
        const Vec2 a = axes (v), scaled = a.cwiseProduct (v);
        const double length = scaled.norm();
        return length > 0.0 ? Vec2 (a.cwiseProduct (scaled / length)) : Vec2 (Vec2::Zero());
    }

    /// The unit normal of the bound, enlarged `times`, at its point nearest to a stretch d outside of it. Newton's method on
    /// 1 / |q (t)| = 1, q_i = a_i d_i / (t + a_i^2), which is concave, so it comes from below and never goes too far.
    Vec2 normalNearest (const Vec2& d, double times = 1.0) const noexcept
    {
        constexpr int most = 50;   // steps; 3 to 6 are usual
        const Vec2 a = times * axes (d), aa = a.cwiseProduct (a), ad = a.cwiseProduct (d.cwiseAbs());
        double t = std::max (0.0, (ad - aa).maxCoeff());
        for (int i = 0; i < most; ++i)
        {
            const Vec2 below = aa.array() + t, q = ad.cwiseQuotient (below), qq = q.cwiseProduct (q);
            const double s = qq.sum();
            const double next = t + s * (std::sqrt (s) - 1.0) / qq.cwiseQuotient (below).sum();
            if (! (s > 1.0 && next > t)) break;
            t = next;
        }
        const Vec2 n = d.array() / (aa.array() + t);
        return n / n.norm();
    }
};

/// The bristle of bristle.hpp on a grain. It slips along the normal of its bound, so that of all stretches that the bound allows, it keeps the
/// one in which the slip costs most (associated flow). On a circle, this is the bristle itself.
struct GrainedBristle
{
    using Vec2 = FrictionBound::Vec2;

    /// One step: the new stretch, the energy lost in the step divided by sigma (m²), and whether the contact point has moved.
    struct Step
    {
        Vec2 d { 0.0, 0.0 };
        double loss = 0.0;
        bool slips = false;
    };

    const FrictionBound& bound;
    const Bristle& unit;   ///< the adhesion function, for a bound of length 1

    /// Moves the tool by dp, in a straight line.
    Step stretch (const Vec2& d, const Vec2& dp) const noexcept { return unit.adhesion == BristleAdhesion::stick ? stick (d, dp) : yield (d, dp); }

    /// The stretch that is left if the bound has become too short for d. The caller counts the energy that this releases.
    Step letGo (const Vec2& d) const noexcept
    {
        if (unit.adhesion == BristleAdhesion::stick) return stick (d, Vec2::Zero());
        Step step { .d = d };
        cut (step);
        return step;
    }

private:
    static constexpr double eps_slip = margin (1e-9);   // relative, as in bristle.hpp

    /// Eq. (3) with the nearest point of the bound. With stick-slip, the stretch grows from the bound along its normal n by `tooth`, collapses, and
    /// grows again; a large step contains several collapses.
    Step stick (const Vec2& d, const Vec2& dp) const noexcept
    {
        Step step { .d = d + dp };
        if (! (bound.share (step.d) > unit.d_stick * (1.0 + eps_slip))) return step;
        const Vec2 n = bound.normalNearest (step.d), least = bound.withNormal (n), ratios = n.cwiseQuotient (bound.axes (n));
        const double h = least.dot (n), k = ratios.squaredNorm(), m = unit.d_stick * unit.d_stick - 1.0;
        const double tooth = m > 2.0 * eps_slip ? m / (1.0 / h + std::sqrt (1.0 / (h * h) + k * m)) : 0.0;   // least + tooth n has the share d_stick
        const double beyond = std::max (0.0, (step.d - least).dot (n) - tooth), rest = tooth > 0.0 ? math::fmod (beyond, tooth) : 0.0;
        step.d = least + rest * n;
        step.loss = (beyond - rest + tooth) * (h + 0.5 * tooth);
        step.slips = true;
        return step;
    }

    /// Eq. (2) with its slip along the normal, dd = dp - Z h (dp) A^-1 d, h (v) the support of the bound and A the squares of its half axes. It is
    /// solved with Z and the half held over the step, each axis on its own.
    Step yield (const Vec2& d, const Vec2& dp) const noexcept
    {
        const Vec2 pulled = d + dp, a = bound.axes (pulled);
        const double pace = unit.zeta (bound.share (pulled)) * bound.support (dp);
        Step step { .d = pulled };
        if (! (pace > 0.0)) return step;
        double work = 0.0;
        for (int i = 0; i < 2; ++i)
        {
            const double x = pace / a[i] / a[i], gone = -math::expm1 (-x), phi = gone / x;
            const double psi = x < 1e-3 ? 1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0)) : (1.0 - phi) / x;
            step.d[i] = (1.0 - gone) * d[i] + phi * dp[i];
            work += (phi * d[i] + psi * dp[i]) * dp[i];
        }
        step.loss = std::max (0.0, work - 0.5 * (step.d - d).dot (step.d + d));
        step.slips = true;
        cut (step);
        return step;
    }

    /// Cuts a stretch at which the bristle would yield faster than the tool can move.
    void cut (Step& step) const noexcept
    {
        const double share = bound.share (step.d), yields = unit.zeta (share);
        if (! (yields * share > 1.0 + eps_slip)) return;
        const Vec2 before = step.d;
        step.d = bound.withNormal (bound.normalNearest (before, 1.0 / yields)) / yields;
        step.loss += 0.5 * (before - step.d).dot (before + step.d);
        step.slips = true;
    }
};

}   // namespace tactus
