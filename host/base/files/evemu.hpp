// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/device/trace.hpp>
#include <tactus/text/result.hpp>

#include <string_view>

namespace tactus::host
{

/// Settings for converting a pen on a tablet to a hand on a surface.
struct EvemuOptions
{
    double pitch = 0.0;           ///< length of a unit of ABS_X and ABS_Y, in m; 0: from the recording, else 5 um (Wacom)
    double full_pressure = 0.0;   ///< units at full pressure; 0: from the recording, else 2047 or the largest value that occurs, whichever is larger
    double full_force = 3.0;      ///< force at full pressure, in N
    double full_depth = 2e-3;     ///< depth below the surface at full pressure, in m
    double lift = 5e-3;           ///< height above the surface while the pen is up, in m
    double rate_hz = 1000.0;      ///< rate of the rows
    double landing = 0.04;        ///< how long the pen takes to come down or to go up, in s
};

/// Converts a recording of a pen tablet (`evemu-record`, or any text with lines `E: sec.usec type code value`, type and
/// code in hex) to a trace with evenly spaced rows. Errors give the line number.
///
///     x, y       straight from report to report, centred on the middle of the drawing, y away from the user (tablets
///                count towards the user). A pen that leaves the tablet reports 0, 0; this is not treated as motion.
///                While the pen is away, the hand moves with minimum jerk from where it was last seen to where the
///                pen comes back.
///     z          -full_depth pressure/full_pressure while the tip touches (BTN_TOUCH, or a pressure if the tablet has
///                no BTN_TOUCH), else +lift; then smoothed by a raised cosine `landing` wide, without a delay. A
///                tablet does not measure height, so the descent is invented. It reaches the surface within a quarter
///                of `landing` of the touch.
///     pressure   full_force pressure/full_pressure while the tip touches, else 0
///
/// Ids: evemu/bad_line, evemu/time_order, evemu/no_motion, evemu/too_long.
Result<TraceData> readEvemu (std::string_view text, const EvemuOptions& = {});

}   // namespace tactus::host
