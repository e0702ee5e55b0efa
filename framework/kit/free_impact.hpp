// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus
{

/// The state of a mass m in a contact: m d'' = -N (d, d'), with d' > 0 on the way in.
struct MotionState
{
    double d = 0.0, v = 0.0;   // m, m/s
};

/// The end of a contact that a free mass entered: how long the contact lasted, and how fast the mass leaves.
struct Rebound
{
    double duration = std::numeric_limits<double>::infinity();   ///< of the contact, in s; infinite: the contact did not end in time
    double speed = 0.0;                                          ///< on the way out, in m/s

    bool isKnown() const noexcept { return duration < std::numeric_limits<double>::infinity(); }
};

namespace detail
{
/// One step of the classical Runge-Kutta method.
template <typename Force>
MotionState rungeKuttaStep (const Force& N, double m, const MotionState& x, double h) noexcept
{
    const auto slope = [&] (double d, double v) noexcept { return MotionState { v, -N (d, v) / m }; };
    const auto a = slope (x.d, x.v);
    const auto b = slope (x.d + 0.5 * h * a.d, x.v + 0.5 * h * a.v);
    const auto c = slope (x.d + 0.5 * h * b.d, x.v + 0.5 * h * b.v);
    const auto e = slope (x.d + h * c.d, x.v + h * c.v);
    return { x.d + h / 6.0 * (a.d + 2.0 * (b.d + c.d) + e.d), x.v + h / 6.0 * (a.v + 2.0 * (b.v + c.v) + e.v) };
}

/// The duration of a contact in s, to within a few percent. Uses the semi-implicit Euler rule with ever shorter steps, until the
/// contact takes at least 16. Infinite if the contact is not over after `longest`, or if damping stops the mass inside.
template <typename Force>
double roughDuration (const Force& N, double m, double v, double longest) noexcept
{
    constexpr double never = std::numeric_limits<double>::infinity();
    constexpr int first = 64, later = 1024, enough = 16, passes = 80;   // each pass shortens the step to half or less
    double h = longest / first;
    for (int pass = 0; pass < passes; ++pass)
    {
        const int most = pass == 0 ? first : later;   // too long a step throws the mass back too soon, so the contact may be longer than it seemed
        MotionState x { 0.0, v };
        int n = 0;
        do
        {
            x.v -= h * N (x.d, x.v) / m;
            x.d += h * x.v;
            ++n;
        } while (x.d > 0.0 && n < most);
        if (x.d > 0.0) return never;
        if (n >= enough) return n * h;
        h *= n / (2.0 * enough);
    }
    return never;
}
}   // namespace detail

/// Solves the impact of a free mass m (kg) that enters a contact at v (m/s) and leaves it within `longest` (s). N (d, v) is the force
/// in N, 0 for d <= 0. `visit` is called with the MotionState at each multiple of `grid` (s) while the mass is inside. Needs at most about
/// 5000 evaluations of N, usually 400. Speed and duration are exact to about 1e-5 if the force at the touch rises in proportion to
/// depth or more slowly. [any thread]
template <typename Force, typename Visit>
Rebound freeImpact (const Force& N, double m, double v, double longest, double grid, Visit visit) noexcept
{
    const double rough = detail::roughDuration (N, m, v, longest);
    if (! (rough < std::numeric_limits<double>::infinity())) return {};

    constexpr int steps_per_contact = 64, most = 512;
    const double per_grid = std::max (1.0, std::ceil (steps_per_contact * grid / rough)), h = grid / per_grid;
    MotionState x { 0.0, v };
    double since_grid = 0.0;
    for (int n = 0; n < most; ++n)
    {
        const auto next = detail::rungeKuttaStep (N, m, x, h);
        if (! (next.d > 0.0))
        {
            double part = x.d > 0.0 ? x.d / (x.d - next.d) : 1.0;   // share of the step until the mass reaches the surface
            auto out = detail::rungeKuttaStep (N, m, x, part * h);
            if (out.v < 0.0) part = std::clamp (part - out.d / (out.v * h), 0.0, 1.0);
            out = detail::rungeKuttaStep (N, m, x, part * h);
            return { .duration = (n + part) * h, .speed = -out.v };
        }
        x = next;
        if (++since_grid < per_grid) continue;
        since_grid = 0.0;
        visit (x);
    }
    return {};
}

template <typename Force>
Rebound freeImpact (const Force& N, double m, double v, double longest) noexcept
{
    return freeImpact (N, m, v, longest, longest, [] (const MotionState&) noexcept {});
}

}   // namespace tactus
