// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/rotation.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace tactus::host::falcon
{

/// The three legs of the Falcon, in its own axes: x right, y up, z away from the base, in m. Lengths and angles are those of libnifalcon, whose equations
/// come from R. E. Stamper's thesis (1997). The solution and its derivative do not come from there.
class Kinematics
{
    static constexpr double degree = std::numbers::pi / 180.0;
    static constexpr double thigh = 0.060, shin = 0.1025;   // in m, and the offsets of their joints
    static constexpr double offset_c = 0.01443, offset_d = 0.01125, offset_e = 0.01125, offset_f = -0.025, offset_r = 0.0400, offset_s = -0.02309;
    static constexpr double directions[] { 105.0 * degree, -15.0 * degree, -135.0 * degree };   // of the legs: top, right, left
    static constexpr double first_angle = 35.0 * degree, per_count = 0.01425 / 1280.0 * 360.0 / 0.110 * degree;
    static constexpr double least_angle = -90.0 * degree, most_angle = 150.0 * degree;   // far beyond the stops of a thigh

public:
    /// The angles of the thighs from the counts of the encoders, in rad.
    static Vec3 anglesOf (const std::array<int, 3>& counts)
    {
        return Vec3::Constant (first_angle) + per_count * Eigen::Map<const Eigen::Vector3i> (counts.data()).cast<double>();
    }

    /// The place of the grip for these angles, by Newton's method, to far less than 1 nm. Empty if there is no such place.
    std::optional<Vec3> placeOf (const Vec3& angles)
    {
        constexpr int most_steps = 30;
        constexpr double longest_step = 0.02, close_enough = 1e-13, nearest = 0.03, farthest = 0.25;   // in m
        moves.setZero();
        if (angles.minCoeff() < least_angle || angles.maxCoeff() > most_angle) return std::nullopt;
        Vec3 at { 0.0, 0.0, 0.13 };   // always from the middle, so that the same angles give the same place to the last bit
        for (int step = 0; step < most_steps; ++step)
        {
            Vec3 gaps, by_angle;   // between each leg and the grip, in m^2, and the derivatives with the angle and with the place
            Mat3 by_place;
            for (int leg = 0; leg < 3; ++leg)
            {
                const double c = std::cos (directions[leg]), s = std::sin (directions[leg]);
                const double u = at.x() * c + at.y() * s - offset_r, v = -at.x() * s + at.y() * c - offset_s;
                const double aside = (v + offset_f) / shin, along = std::sqrt (1.0 - aside * aside);   // not a number if the shin is too short
                const double reach = offset_d + offset_e + shin * along;
                const double x = u + offset_c - thigh * std::cos (angles[leg]), z = at.z() - thigh * std::sin (angles[leg]);
                const double by_v = reach * aside / along;   // the reach shrinks by aside / along
                gaps[leg] = x * x + z * z - reach * reach;
                by_angle[leg] = 2.0 * thigh * (x * std::sin (angles[leg]) - z * std::cos (angles[leg]));
                by_place.row (leg) = 2.0 * Vec3 (x * c - by_v * s, x * s + by_v * c, z);
            }
            const Mat3 inverse = by_place.inverse();
            const Vec3 change = -inverse * gaps;
            const double length = change.norm();
            if (! std::isfinite (length)) break;
            at += change * std::min (1.0, longest_step / length);
            if (length > close_enough) continue;
            if (at.z() < nearest || at.z() > farthest) break;   // behind the base, where the equations hold as well
            moves = -inverse * by_angle.asDiagonal();
            return at;
        }
        return std::nullopt;
    }

    /// The torques of the motors, in N m, that give this force on the grip at the last place.
    Vec3 torquesOf (const Vec3& force) const { return moves.transpose() * force; }

private:
    Mat3 moves = Mat3::Zero();   // of the place with each angle, by columns, in m/rad
};

}   // namespace tactus::host::falcon
