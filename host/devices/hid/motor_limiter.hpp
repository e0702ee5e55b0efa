// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

#include <array>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// The values of all efforts of a device, in the order of HidModel::effortNames().
using EffortValues = std::array<double, most_efforts>;

/// The last limit before the report: it acts on the values of the motors, after the force at the tool has been mapped to them. One
/// factor scales all mechanical efforts of a device (force, torque, and efforts in N, N m or A), so directions are kept:
///
///     size    v = k u          so that each motor stays within its field's min and max, and within max_motor
///     slew    w' = w + s (v - w)   so that no motor changes by more than max_motor_slew t in the time t since the last call
///
/// k changes from tick to tick, so it could change a torque, an axis, or the force of a Direct device faster than the guard allows. So
/// s also keeps these within max_torque_slew, max_axis_slew and max_slew. A driver measures t by the wall clock, so these limits hold for
/// the device even if a run ticks faster than it says.
///
/// Other values, such as the frequency of a rumble motor, pass through unchanged. max_motor and max_motor_slew hold for the
/// motors that render the force.
class MotorLimiter
{
public:
    MotorLimiter (const Profile&, const std::vector<std::string>& effort_names, const std::vector<std::string>& effort_units, const EffortValues& rest);

    /// Adds the slew limits of the role's guard to those of the profile, per s. [main thread, before the first call]
    void tighten (double force, double torque, double axis) noexcept;

    /// The factors k and s.
    struct ScaleFactors
    {
        double size = 1.0, step = 1.0;
    };

    /// Scales the efforts so that each motor stays within its limit, and returns k. [any thread that owns it]
    double shrink (EffortValues&) const noexcept;

    /// Applies both limits. `passed_s`: the time since the last call, in s. [tick thread]
    ScaleFactors operator() (EffortValues&, double passed_s) noexcept;

    /// The neutral reports are sent instead of efforts. [tick thread]
    void forget() noexcept { last = at_rest; }

private:
    struct Motor
    {
        std::size_t effort;                                            // index
        double least = -GuardLimits::none, most = GuardLimits::none;   // of the effort's value; 0: the motor has no such direction
        double slew = GuardLimits::none;                               // per s
    };

    /// Efforts that are limited as one vector.
    struct Group
    {
        std::vector<std::size_t> efforts;   // indices
        double slew = GuardLimits::none;    // per s
    };

    double stepShare (const EffortValues& values, double passed_s) const noexcept;

    std::vector<Motor> motors;
    std::vector<Group> groups;    // of single axes, then of the force, then of the torque
    EffortValues at_rest, last;   // last: what was sent
};

}   // namespace tactus::host::hid
