// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/trace.hpp>

#include <string_view>

namespace tactus::host
{

/// How a pen on a tablet becomes a hand over a surface.
struct EvemuOptions
{
    double pitch = 0.0;           ///< m a unit of ABS_X and ABS_Y; 0: as the recording says, else 5 um (Wacom)
    double full_pressure = 0.0;   ///< units at full pressure; 0: as the recording says, else 2047, or the most there is
    double full_force = 3.0;      ///< N at full pressure
    double full_depth = 2e-3;     ///< m that the tip is under the surface at full pressure
    double lift = 5e-3;           ///< m above the surface while the pen is up
    double rate_hz = 1000.0;      ///< of the rows
    double landing = 0.04;        ///< s that the way down, or up, is spread over
};

/// Reads a recording of a pen tablet (`evemu-record`, or any text with its lines `E: sec.usec type code value`, type
/// and code in hex) as a trace with rows at an even rate. Messages tell the line.
///
///     x, y       straight from report to report, centred on the middle of all that was drawn, y away from the person
///                (tablets count towards them). Pens that leave report 0, 0: that is no motion. The hand stays where
///                it was last seen, and while the pen is away it moves to where it comes back with the least jerk.
///     z          -full_depth pressure/full_pressure while the tip touches (BTN_TOUCH, or a pressure where the tablet
///                has none), else +lift; then smoothed by a raised cosine `landing` wide, which delays nothing.
///                A tablet does not measure it: the way down is made up. It meets the surface within a quarter of
///                `landing` of the touch.
///     pressure   full_force pressure/full_pressure while the tip touches, else 0
///
/// Ids: evemu/bad_line, evemu/time_order, evemu/no_motion, evemu/too_long.
TraceResult readEvemu (std::string_view text, const EvemuOptions& = {});

}   // namespace tactus::host
