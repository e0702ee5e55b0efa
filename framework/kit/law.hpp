// SPDX-License-Identifier: MIT
#pragma once

#include "curve.hpp"
#include "math/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus
{

/// A force-deflection law: the force at a deflection e >= 0, and the energy stored on the way there.
///
///     power        f = k e^n                  energy = k e^(n+1) / (n+1)
///     exponential  f = a (exp (b e) - 1)      energy = a ((exp (b e) - 1) / b - e)
///     table        straight between points from (0, 0), then continued with the last slope
///     dissipation  for damping only: a times the stiffness law given with it; the node multiplies them
///
/// In files {"power": [k, n]}, {"exponential": [a, b]}, {"table": [[e…], [f…]]}, {"dissipation": a}. All are 0 for e <= 0.
/// A law of kind `none` means "not given"; the node's doc block says what happens then. On its own it is 0 everywhere, as
/// is a law of kind `dissipation`.
struct Law
{
    enum class Kind
    {
        none,
        power,
        exponential,
        table,
        dissipation
    };

    Kind kind = Kind::none;
    double a = 0.0, b = 1.0;   ///< power: k and n; exponential: a and b; dissipation: only a
    Curve table {};

    explicit operator bool() const noexcept { return kind != Kind::none; }
    bool operator== (const Law&) const = default;

    double operator() (double e) const noexcept
    {
        if (! (e > 0.0)) return 0.0;
        switch (kind)
        {
        case Kind::power:
            return b == 1.0 ? a * e : a * raised (e, b);
        case Kind::exponential:
            return a * math::expm1 (b * e);
        case Kind::table:
            return along (e).force;
        case Kind::none:
        case Kind::dissipation:
            break;
        }
        return 0.0;
    }

    double energy (double e) const noexcept
    {
        if (! (e > 0.0)) return 0.0;
        switch (kind)
        {
        case Kind::power:
            return b == 1.0 ? 0.5 * a * e * e : a * raised (e, b + 1.0) / (b + 1.0);
        case Kind::exponential:
            return a * (math::expm1 (b * e) / b - e);
        case Kind::table:
            return along (e).energy;
        case Kind::none:
        case Kind::dissipation:
            break;
        }
        return 0.0;
    }

    struct Point
    {
        double force = 0.0, energy = 0.0;
    };

    /// Force and energy together, which costs less than computing each separately.
    Point at (double e) const noexcept
    {
        if (! (e > 0.0)) return {};
        switch (kind)
        {
        case Kind::exponential:
        {
            const double rise = math::expm1 (b * e);
            return { a * rise, a * (rise / b - e) };
        }
        case Kind::table:
            return along (e);
        case Kind::power:
        case Kind::none:
        case Kind::dissipation:
            break;
        }
        return { (*this) (e), energy (e) };
    }

    /// The smallest deflection at which the force is f: 0 for f <= 0, infinite if the law never reaches f.
    double inverse (double f) const noexcept
    {
        constexpr double never = std::numeric_limits<double>::infinity();
        if (! (f > 0.0)) return 0.0;
        switch (kind)
        {
        case Kind::power:
            return b == 1.0 ? f / a : math::pow (f / a, 1.0 / b);
        case Kind::exponential:
            return math::log1p (f / a) / b;
        case Kind::table:
        {
            double x = 0.0, y = 0.0, slope = 0.0;
            for (std::size_t i = 0; i < table.x.size() && y < f; ++i)
            {
                if (table.x[i] <= x) continue;
                slope = (table.y[i] - y) / (table.x[i] - x);
                if (table.y[i] >= f) break;
                x = table.x[i];
                y = table.y[i];
            }
            return slope > 0.0 ? x + (f - y) / slope : never;
        }
        case Kind::none:
        case Kind::dissipation:
            break;
        }
        return never;
    }

    /// True if the force never falls and never pulls.
    bool rises() const noexcept
    {
        return kind != Kind::table || (std::ranges::is_sorted (table.y) && (table.empty() || table.y.front() >= 0.0));
    }

    /// The largest slope between 0 and this deflection.
    double steepest (double to = std::numeric_limits<double>::infinity()) const noexcept
    {
        if (! (to > 0.0)) return 0.0;
        switch (kind)
        {
        case Kind::power:
            if (b == 1.0 || a == 0.0) return a;
            return b > 1.0 ? a * b * math::pow (to, b - 1.0) : std::numeric_limits<double>::infinity();
        case Kind::exponential:
            return a == 0.0 ? 0.0 : a * b * math::exp (b * to);
        case Kind::table:
        {
            double x = 0.0, y = 0.0, most = 0.0;
            for (std::size_t i = 0; i < table.x.size() && x < to; ++i)
            {
                if (table.x[i] <= x) continue;
                most = std::max (most, (table.y[i] - y) / (table.x[i] - x));
                x = table.x[i];
                y = table.y[i];
            }
            return most;
        }
        case Kind::none:
        case Kind::dissipation:
            break;
        }
        return 0.0;
    }

private:
    /// e^n for e > 0. The common powers need no logarithm: 1.5 is the force of a sphere (Hertz), 2 that of a cone, and 2.5 and 3 are their
    /// energies.
    static double raised (double e, double n) noexcept
    {
        if (n == 1.5) return e * std::sqrt (e);
        if (n == 2.0) return e * e;
        if (n == 2.5) return e * e * std::sqrt (e);
        if (n == 3.0) return e * e * e;
        return math::pow (e, n);
    }

    Point along (double e) const noexcept
    {
        double x = 0.0, y = 0.0, slope = 0.0, energy = 0.0;
        for (std::size_t i = 0; i < table.x.size() && x < e; ++i)
        {
            if (table.x[i] <= x) continue;   // a first point at (0, 0) is implied, but may be given
            slope = (table.y[i] - y) / (table.x[i] - x);
            const double step = std::min (table.x[i], e) - x;
            energy += step * (y + 0.5 * slope * step);
            x += step;
            y += slope * step;
        }
        const double beyond = e - x;
        return { y + slope * beyond, energy + beyond * (y + 0.5 * slope * beyond) };
    }
};

}   // namespace tactus
