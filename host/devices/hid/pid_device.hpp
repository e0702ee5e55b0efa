// SPDX-License-Identifier: MIT
#pragma once

#include "calibration.hpp"
#include "profile.hpp"
#include "report_descriptor.hpp"

#include <tactus/text/message.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// A joystick or wheel with force feedback, as described by its report descriptor (Device Class Definition for Physical
/// Interface Devices 1.0). It creates one constant force effect on the device and updates it on every tick; our models
/// need nothing else.
///
/// The init steps clear all effects, create a constant force effect, read the block assigned to it, and set up the effect
/// with zero force. The exit steps stop all effects and free the block. The outputs are the force and `start`, which
/// restarts the effect every 0.2 s. The effect lasts 0.5 s, so the force ends on its own if the host dies.
///
/// There is one effort, `force`, to the right, and axes named after their usages: x, y, z, rx … With a calibration, x, y
/// and z are the position of the tool and `force` is the force on it along x. With a full force along y, a second effect renders
/// `force_y`, towards the user. For a wheel, `steering` (else x) is its
/// rotation about y, clockwise positive as the user sees it, and `force` is the torque. [main thread]
///
/// With a calibration, the profile limits force and slew, and, if the travel of the driven axis is known, speed, energy and how long the
/// axis may stay exactly the same under force (docs/safety.md).
class PidDevice
{
public:
    /// Empty, with a message, if the descriptor lacks something that a constant force needs. Ids: pid/missing.
    static std::optional<PidDevice> from (const ReportDescriptor&, Messages&);

    /// True if the descriptor contains any force feedback, even if it is not enough for a constant force.
    static bool isMeantBy (const ReportDescriptor&) noexcept;

    /// The feature report that creates a constant force.
    Bytes createEffect() const;

    /// The feature report that requests the block of the effect, with the right id and length, and the expected answer.
    /// Ids: pid/full, pid/refused.
    Bytes blockLoad() const;
    Answer answer() const;

    /// A profile that drives the effect. It has no match rules; the caller adds them.
    Profile profile (const PidCalibration& = {}) const;

    /// The axes that the device reports.
    std::vector<std::string> axisNames() const;

    /// True if its effects may act along y, too.
    bool hasForceAlongY() const noexcept;

private:
    explicit PidDevice (const ReportDescriptor& d) : descriptor (d) {}

    const ReportDescriptor descriptor;
};

}   // namespace tactus::host::hid
