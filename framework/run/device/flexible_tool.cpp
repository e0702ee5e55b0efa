// SPDX-License-Identifier: MIT
#include "flexible_tool.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus
{
namespace
{
constexpr double finest_s = 1e-12;
constexpr int finest_level = 40, finest_grid = 8, most_phases = 64;   // the header states the bounds that follow
constexpr double tie = 1e-12;                                         // relative: with a load this close to the Coulomb friction, the motor still sticks

using Square = Eigen::Matrix<double, 6, 6>;

/// The number of halvings after which a number is at most 1, but never more than `most`.
int halvingsOf (double number, int most) noexcept
{
    int n = 0;
    while (n < most && number > std::ldexp (1.0, n))
        ++n;
    return n;
}

/// e^A - 1, accurate also where A is small: the series for A / 2^n, then n doublings, e^2x - 1 = 2 (e^x - 1) + (e^x - 1)^2.
Square exponentialMinusOne (const Square& a)
{
    const double norm = a.cwiseAbs().rowwise().sum().maxCoeff();
    const int doublings = halvingsOf (norm / 0.25, 100);
    const Square part = std::ldexp (1.0, -doublings) * a;

    Square sum = Square::Zero();   // Horner's rule for part (1 + part/2 (1 + part/3 (...)))
    for (int n = 14; n >= 1; --n)
        sum = part * (Square::Identity() + sum) / n;
    for (int i = 0; i < doublings; ++i)
        sum = 2.0 * sum + sum * sum;
    return sum;
}

std::int64_t unitsOf (int finest, int level) noexcept { return std::int64_t { 1 } << (finest - level); }
}   // namespace

FlexibleTool::FlexibleTool (const Properties& properties, double dt_s) : what (properties)
{
    const double m = what.motor_mass, e = what.end_mass, w = 2.0 * std::numbers::pi * what.first_mode_hz;
    k = e * w * w;
    c = 2.0 * what.first_mode_damping * e * w;

    // Rows and columns: w x, v, w stretch, end_v, motor force / (m w), hand force / (e w). So all entries are rates, in 1/s.
    Square slip = Square::Zero();
    slip (0, 1) = w;
    slip.row (1) << 0.0, -(what.damping + c) / m, k / (m * w), c / m, w, 0.0;
    slip.row (2) << 0.0, -w, 0.0, w, 0.0, 0.0;
    slip.row (3) << 0.0, c / e, -w, -c / e, 0.0, w;
    Square stick = slip;
    stick.row (0).setZero();
    stick.row (1).setZero();
    stick.col (1).setZero();

    const Eigen::Vector<double, 6> scale { 1.0 / w, 1.0, 1.0 / w, 1.0, m * w, e * w };
    const auto changeIn = [&] (const Square& rates, double time) -> Change {
        const Square change = scale.asDiagonal() * exponentialMinusOne (time * rates) * scale.cwiseInverse().asDiagonal();
        return change.block<4, 5> (0, 1);
    };
    finest = what.coulomb > 0.0 ? std::max (1, halvingsOf (dt_s / finest_s, finest_level)) : 0;
    for (int level = 0; level <= finest; ++level)
    {
        slips.push_back (changeIn (slip, std::ldexp (dt_s, -level)));
        sticks.push_back (changeIn (stick, std::ldexp (dt_s, -level)));
    }

    const double share = 1.0 + e / m, fastest = w * std::sqrt (share) + c / e * share + what.damping / m;   // rate of the two free masses, in 1/s
    grid = halvingsOf (dt_s * fastest / 0.4, std::min (finest_grid, finest));
}

void FlexibleTool::start (const Vec3& position, const Vec3& velocity) noexcept
{
    for (int i = 0; i < 3; ++i)
        axes[static_cast<std::size_t> (i)] = { .x = position[i], .v = velocity[i], .end_v = velocity[i] };
    most_phases_seen = 0;
}

void FlexibleTool::step (const Vec3& motor_force, const Vec3& hand_force) noexcept
{
    for (int i = 0; i < 3; ++i)
    {
        auto& axis = axes[static_cast<std::size_t> (i)];
        const AppliedForces held { motor_force[i], hand_force[i] };
        if (what.coulomb > 0.0)
            most_phases_seen = std::max (most_phases_seen, stepDryAxis (axis, held));
        else
            axis = advanced (axis, Phase::forward, held, 0);
    }
}

double FlexibleTool::energy() const noexcept
{
    double twice = 0.0;
    for (const auto& a : axes)
        twice += what.motor_mass * a.v * a.v + what.end_mass * a.end_v * a.end_v + k * a.stretch * a.stretch;
    return 0.5 * twice;
}

/// The state after dt / 2^level, if the phase lasts that long.
FlexibleTool::Axis FlexibleTool::advanced (const Axis& a, Phase phase, AppliedForces held, int level) const noexcept
{
    const double motor = held.motor - static_cast<int> (phase) * what.coulomb;
    const Eigen::Vector<double, 5> given { a.v, a.stretch, a.end_v, motor, held.hand };
    const auto& change = (phase == Phase::stick ? sticks : slips)[static_cast<std::size_t> (level)];
    const Eigen::Vector4d by = change * given;
    return { .x = a.x + by[0], .v = a.v + by[1], .stretch = a.stretch + by[2], .end_v = a.end_v + by[3] };
}

/// While the motor slips: its speed in the direction of the slip. While it sticks: the distance of the load to the Coulomb friction
/// on one side.
FlexibleTool::Margin FlexibleTool::margin (const Axis& a, Phase phase, AppliedForces held, int side) const noexcept
{
    const double elastic = k * a.stretch + c * (a.end_v - a.v);
    const int way = static_cast<int> (phase);
    if (phase != Phase::stick) return { way * a.v, (way * (held.motor + elastic - what.damping * a.v) - what.coulomb) / what.motor_mass };

    const double load_rate = k * a.end_v + c * (held.hand - elastic) / what.end_mass;
    return { what.coulomb * (1.0 + tie) - side * (held.motor + elastic), -side * load_rate };
}

FlexibleTool::Phase FlexibleTool::phaseOf (const Axis& a, AppliedForces held) const noexcept
{
    if (a.v != 0.0) return a.v > 0.0 ? Phase::forward : Phase::backward;
    const double load = held.motor + k * a.stretch + c * a.end_v;
    if (std::abs (load) <= what.coulomb * (1.0 + tie)) return Phase::stick;
    return load > 0.0 ? Phase::forward : Phase::backward;
}

/// Moves the axis through a tick and returns the number of phases.
int FlexibleTool::stepDryAxis (Axis& axis, AppliedForces held) const noexcept
{
    auto left = unitsOf (finest, 0);
    int phases = 0;
    for (; left > 0 && phases < most_phases; ++phases)
        left -= run (axis, phaseOf (axis, held), held, left);

    if (left > 0) axis.v = 0.0;
    for (int level = 0; left > 0; ++level)
        if (const auto units = unitsOf (finest, level); units <= left)
        {
            axis = advanced (axis, Phase::stick, held, level);
            left -= units;
        }
    return phases;
}

/// Moves the axis to the end of the phase, but by at most `most` units of time. Returns the number of units that have passed.
std::int64_t FlexibleTool::run (Axis& axis, Phase phase, AppliedForces held, std::int64_t most) const noexcept
{
    std::int64_t gone = 0;
    while (gone < most)
    {
        int level = grid;
        while (unitsOf (finest, level) > most - gone)
            ++level;
        const auto next = advanced (axis, phase, held, level);
        if (const auto units = unitsToEnd (axis, next, phase, held, level); units > 0) return gone + units;
        axis = next;
        gone += unitsOf (finest, level);
    }
    return gone;
}

/// If the phase ends in the step from `axis` to `next`, moves the axis to the end of the phase and returns the number of units that
/// have passed; else returns 0.
///
/// The phase ends if a margin is negative at the end of the step, or if a margin falls and rises again within the step and its lowest
/// value is negative.
std::int64_t FlexibleTool::unitsToEnd (Axis& axis, const Axis& next, Phase phase, AppliedForces held, int level) const noexcept
{
    std::int64_t first = 0;
    Axis end;
    for (const int side : { 1, -1 })
    {
        if (phase != Phase::stick && side < 0) break;   // only sticking has a second margin
        const auto after = margin (next, phase, held, side);
        const bool crosses = after.value < 0.0;
        if (! crosses && ! (after.rate > 0.0 && margin (axis, phase, held, side).rate < 0.0)) continue;

        Axis at = axis;
        std::int64_t units = 1;
        for (int l = level + 1; l <= finest; ++l)
        {
            const auto half = advanced (at, phase, held, l);
            const auto there = margin (half, phase, held, side);
            if (there.value < 0.0 || (! crosses && there.rate >= 0.0)) continue;
            at = half;
            units += unitsOf (finest, l);
        }
        at = advanced (at, phase, held, finest);   // just beyond the end of the phase, so that phaseOf finds the next one
        if (margin (at, phase, held, side).value >= 0.0 || (first > 0 && units >= first)) continue;
        first = units;
        end = at;
    }
    if (first == 0) return 0;
    axis = end;
    if (phase != Phase::stick) axis.v = 0.0;
    return first;
}

}   // namespace tactus
