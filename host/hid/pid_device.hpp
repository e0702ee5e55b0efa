// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>
#include <host/hid/report_descriptor.hpp>

#include <framework/message.hpp>

#include <optional>
#include <span>

namespace tactus::host::hid
{

/// A joystick or wheel with force feedback, as its report descriptor tells it (Device Class Definition for Physical
/// Interface Devices 1.0). One constant force is created on it and changed at the rate of the loop, which is all that
/// a model of ours needs. A driver does this:
///
///     send createEffect()                      a feature report
///     ask for blockLoad(), read block()        a feature report: where the device put the effect
///     HidModel (profile (block))               init: actuators on, full gain, the effect set, of no force yet
///
/// Its outputs are the force, and `start`, which starts the effect again each 0.2 s: it lasts 0.5 s, so that the force ends
/// by itself where the host does.
/// There is one effort, `force`, -1…1 of what the device can do; its axes are -1…1, too, since descriptors do not
/// tell newtons and metres. exit stops all effects. [main thread]
class PidDevice
{
public:
    /// Nothing, and why, if the descriptor lacks what one constant force needs. Ids: pid/missing.
    static std::optional<PidDevice> from (const ReportDescriptor&, Messages&);

    /// A feature report that asks for a constant force.
    Bytes createEffect() const;

    /// An empty feature report of the id and length to ask with.
    Bytes blockLoad() const;

    /// The number of the effect in the answer; nothing if the device has no room, or the answer is none.
    std::optional<int> block (std::span<const std::uint8_t> answer) const noexcept;

    /// How to drive the effect. The profile has no rule to match: who has it, has opened the device.
    Profile profile (int block) const;

private:
    explicit PidDevice (const ReportDescriptor& d) : descriptor (d) {}

    const ReportDescriptor descriptor;
};

}   // namespace tactus::host::hid
