// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>
#include <host/hid/report_descriptor.hpp>

#include <framework/message.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// What a descriptor does not tell of a force feedback device. Without it, forces and axes are shares, -1…1.
struct PidCalibration
{
    double full_force = 0.0;                                ///< N, or N m where it turns, at the largest magnitude; 0: not known
    bool turns = false;                                     ///< a wheel: full_force is a torque, travels are angles
    bool is_reversed = false;                               ///< it pushes to the left where the standard has it push to the right
    double usable = 1.0;                                    ///< share of the full force that may be asked for
    std::map<std::string, double, std::less<>> travel {};   ///< m or rad from end to end, by axis
};

/// A joystick or wheel with force feedback, as its report descriptor tells it (Device Class Definition for Physical
/// Interface Devices 1.0). One constant force is created on it and changed at the rate of the loop, which is all that
/// a model of ours needs.
///
/// On waking up, the device forgets what effects it had, is asked for a constant force and for the block where it put it,
/// and gets the effect, of no force yet; letting go stops all effects and frees the block. Outputs are the force, and
/// `start`, which starts the effect again each 0.2 s: it lasts 0.5 s, so that the force ends by itself where the host does.
///
/// There is one effort, `force`, to the right, and axes by the names of their usages: x, y, z, rx … With a calibration x, y
/// and z are the place of the tool and `force` is the force on it along x; of a wheel, `steering` (else x) is its rotation
/// about y, clockwise positive as the person sees it, and `force` the torque. [main thread]
class PidDevice
{
public:
    /// Nothing, and why, if the descriptor lacks what one constant force needs. Ids: pid/missing.
    static std::optional<PidDevice> from (const ReportDescriptor&, Messages&);

    /// True if the descriptor has anything of force feedback, if perhaps not enough.
    static bool isMeantBy (const ReportDescriptor&) noexcept;

    /// A feature report that asks for a constant force.
    Bytes createEffect() const;

    /// An empty feature report of the id and length to ask with, and what the device has to answer: where it put the effect.
    /// Ids: pid/full, pid/refused.
    Bytes blockLoad() const;
    Answer answer() const;

    /// How to drive the effect. The profile has no rule to match: who has it, has opened the device.
    Profile profile (const PidCalibration& = {}) const;

    /// The axes that the device tells.
    std::vector<std::string> axisNames() const;

private:
    explicit PidDevice (const ReportDescriptor& d) : descriptor (d) {}

    const ReportDescriptor descriptor;
};

}   // namespace tactus::host::hid
