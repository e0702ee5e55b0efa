// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/law.hpp>
#include <tactus/kit/math/math.hpp>

#include <cmath>
#include <numbers>

namespace tactus
{

/// A flat, homogeneous, isotropic elastic body that is much larger than its contact with the tool. Its force-deflection curves have
/// closed forms. The tool is rigid, the strains are small, and the contact has no friction.
struct HalfSpace
{
    double young = 1e4;     ///< Young's modulus E, Pa; above 0
    double poisson = 0.5;   ///< Poisson's ratio nu, from 0 to 0.5

    /// The contact modulus E* = E / (1 - nu^2) of a rigid tool, Pa. Source: Johnson 1985, eq. (4.20).
    double modulus() const noexcept { return young / (1.0 - poisson * poisson); }

    /// A sphere of this radius (m): f = 4/3 E* sqrt (R) d^1.5, while d is much smaller than R.
    /// Source: Hertz 1882; Johnson 1985, eq. (4.23).
    Law sphere (double radius) const noexcept { return power (4.0 / 3.0 * modulus() * std::sqrt (radius), 1.5); }

    /// The flat end of a cylinder of this radius (m): f = 2 a E* d. Source: Boussinesq 1885; Sneddon 1965; Johnson 1985, eq. (3.36).
    Law punch (double radius) const noexcept { return power (2.0 * radius * modulus(), 1.0); }

    /// A cone with this angle between its axis and its side (rad, above 0, below pi/2): f = 2/pi E* tan (angle) d^2.
    /// Source: Love 1939; Sneddon 1965.
    Law cone (double angle) const noexcept { return power (2.0 / std::numbers::pi * modulus() * math::tan (angle), 2.0); }

    /// The deflection ratio mu_c at which a tool with the friction mu slides: mu (2 - nu) / (2 (1 - nu)). The contact of a sphere slides as
    /// a whole once it has moved sideways by this much, relative to its depth; for a flat punch, this is mu times the ratio of the
    /// stiffness along the normal to the one across it. Source: Cattaneo 1938; Mindlin 1949; Johnson 1985, section 7.2.
    double ratio (double mu) const noexcept { return mu * (2.0 - poisson) / (2.0 * (1.0 - poisson)); }

private:
    static Law power (double k, double n) noexcept { return { .kind = Law::Kind::power, .a = k, .b = n }; }
};

/// The sideways curve with which drag over push is mu at every depth: f^x (e) = mu f^z (e / mu_c). mu_c must be above 0. Below mu_c times the
/// depth it is not the curve of Cattaneo and Mindlin, which is stiffest at first and depends on the depth. [any thread]
inline Law acrossOf (const Law& along, double mu, double mu_c)
{
    Law across = along;
    switch (along.kind)
    {
    case Law::Kind::power:
        across.a = mu * along.a / math::pow (mu_c, along.b);
        break;
    case Law::Kind::exponential:
        across.a = mu * along.a;
        across.b = along.b / mu_c;
        break;
    case Law::Kind::table:
        for (double& e : across.table.x)
            e *= mu_c;
        for (double& f : across.table.y)
            f *= mu;
        break;
    case Law::Kind::none:
    case Law::Kind::dissipation:
        break;
    }
    return across;
}

}   // namespace tactus
