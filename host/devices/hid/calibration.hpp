// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/guard.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// Properties of a force feedback device that it does not report. Without them, forces and axes are fractions, -1…1.
struct PidCalibration
{
    double full_force = 0.0;                                ///< force at the largest magnitude, in N, or in N m for a wheel; 0: unknown
    double full_force_y = 0.0;                              ///< the same along y, in N, of a stick with two motors; 0: it is not driven
    bool turns = false;                                     ///< true for a wheel: full_force is a torque, and travels are angles
    bool is_reversed = false;                               ///< true if the device pushes left where the standard says right
    double usable = 1.0;                                    ///< the fraction of the full force that may be used
    std::map<std::string, double, std::less<>> travel {};   ///< travel of each axis from end to end, in m or rad
};

/// The force of a device ends by itself when the host dies: it is an effect that lasts for `effect_lasts` and is restarted every
/// `effect_restarts`, in s.
inline constexpr double effect_lasts = 0.5, effect_restarts = 0.2;

/// The axis along which the force acts: "steering" of a wheel that has a travel for it, else "x".
std::string drivenAxis (const PidCalibration&);

/// Reads the key "calibration" of a description. Empty if there is no such key. Without `needs_force`, for a device that may have no force at all,
/// full_force may be missing. [any thread]
///
///     "calibration": {"full_force": "4 N", "travel": {"x": "12 cm", "y": "12 cm"}, "reversed": false}
///     "calibration": {"full_force": "4 N", "full_force_y": "3 N", "travel": {"x": "12 cm", "y": "12 cm"}}
///     "calibration": {"full_force": "2.5 N*m", "travel": {"steering": "900 deg"}}
///
/// A device that may have no force has no `full_force_y` either. Ids: those of ObjectReader.
std::optional<PidCalibration> readCalibration (const Json& description, Messages&, bool needs_force = true);

/// The calibration of a device that takes a force and has these axes. Without one, the device's strength is unknown: it is treated as a stick with
/// 10 cm of travel and 10 N of force, of which a tenth may be used. Without the travel of the axis that is driven, a usual one is assumed. Both
/// give a warning. Ids: pid/uncalibrated, pid/no_travel; the error pid/no_axis. [any thread]
PidCalibration calibrationOf (const std::string& product, const std::vector<std::string>& axes, const std::optional<PidCalibration>&, Messages&);

/// The limits of the force or torque of a calibrated device, in the manner of the shipped profiles (docs/safety.md): size, slew, and, if the
/// `travel` of the driven axis is known, speed, energy and stillness. `travel` and `quantum`, its resolution, are in m or rad; 0: unknown.
void limitForce (GuardLimits&, const PidCalibration&, double travel, double quantum);

/// Sets max_still with the least force or torque at which it counts; the time depends on the quantum of the position.
void limitStill (GuardLimits&, const PidCalibration&, double quantum);

/// The slew limit of an effort of this size, per s.
double slewOf (double effort);

}   // namespace tactus::host::hid
