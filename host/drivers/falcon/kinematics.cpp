// SPDX-License-Identifier: MIT
#include "kinematics.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace tactus::host::falcon
{

namespace
{
// In m. The thigh, the shin, and the offsets of their joints.
constexpr double thigh = 0.060, shin = 0.1025;
constexpr double offset_c = 0.01443, offset_d = 0.01125, offset_e = 0.01125, offset_f = -0.025, offset_r = 0.0400, offset_s = -0.02309;
constexpr double degree = std::numbers::pi / 180.0;
constexpr double legs[] { 105.0 * degree, -15.0 * degree, -135.0 * degree };   // top, right, left
constexpr double first_angle = 35.0 * degree, per_count = 0.01425 / 1280.0 * 360.0 / 0.110 * degree;
constexpr double least_angle = -90.0 * degree, most_angle = 150.0 * degree;   // far beyond the stops of a thigh

double dot (const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Triple cross (const Triple& a, const Triple& b) { return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] }; }

/// The gap between a leg and the grip, in m^2, and its derivatives with the place and with the angle.
struct Miss
{
    double size = 0.0, by_angle = 0.0;
    Triple by_place {};
};

Miss missOf (std::size_t leg, const Triple& place, double angle)
{
    const double c = std::cos (legs[leg]), s = std::sin (legs[leg]);
    const double u = place[0] * c + place[1] * s - offset_r, v = -place[0] * s + place[1] * c - offset_s, w = place[2];
    const double aside = (v + offset_f) / shin, along = std::sqrt (1.0 - aside * aside);   // not a number if the shin is too short
    const double reach = offset_d + offset_e + shin * along;
    const double x = u + offset_c - thigh * std::cos (angle), z = w - thigh * std::sin (angle);
    const double by_v = 2.0 * reach * aside / along;   // the reach shrinks by aside / along
    return { x * x + z * z - reach * reach,
             2.0 * thigh * (x * std::sin (angle) - z * std::cos (angle)),
             { 2.0 * x * c - by_v * s, 2.0 * x * s + by_v * c, 2.0 * z } };
}
}   // namespace

Triple Kinematics::anglesOf (const std::array<int, 3>& counts)
{
    return { first_angle + per_count * counts[0], first_angle + per_count * counts[1], first_angle + per_count * counts[2] };
}

std::optional<Triple> Kinematics::placeOf (const Triple& angles)
{
    constexpr int most_steps = 30;
    constexpr double longest_step = 0.02, close_enough = 1e-13, nearest = 0.03, farthest = 0.25;   // in m
    moves = {};
    for (const double angle : angles)
        if (angle < least_angle || angle > most_angle) return std::nullopt;
    Triple at { 0.0, 0.0, 0.13 };   // always from the middle, so that the same angles give the same place to the last bit
    for (int step = 0; step < most_steps; ++step)
    {
        const std::array misses { missOf (0, at, angles[0]), missOf (1, at, angles[1]), missOf (2, at, angles[2]) };
        // The columns of the inverse: the move of the place that makes the gap of one leg smaller.
        const std::array columns { cross (misses[1].by_place, misses[2].by_place), cross (misses[2].by_place, misses[0].by_place),
                                   cross (misses[0].by_place, misses[1].by_place) };
        const double volume = dot (misses[0].by_place, columns[0]);
        Triple change {};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t leg = 0; leg < 3; ++leg)
                change[i] -= columns[leg][i] * misses[leg].size / volume;
        const double length = std::sqrt (dot (change, change));
        if (! std::isfinite (length)) break;
        const double part = length > longest_step ? longest_step / length : 1.0;
        for (std::size_t i = 0; i < 3; ++i)
            at[i] += part * change[i];
        if (length > close_enough) continue;
        if (at[2] < nearest || at[2] > farthest) break;   // behind the base, where the equations hold as well
        for (std::size_t leg = 0; leg < 3; ++leg)
            for (std::size_t i = 0; i < 3; ++i)
                moves[leg][i] = -columns[leg][i] * misses[leg].by_angle / volume;
        return at;
    }
    return std::nullopt;
}

Triple Kinematics::torquesOf (const Triple& force) const { return { dot (force, moves[0]), dot (force, moves[1]), dot (force, moves[2]) }; }

}   // namespace tactus::host::falcon
