// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The true position of a simulated tool, before its encoders round it, and its true velocity.
///
/// Use it for plots and tests, and to see the effect of the resolution. A graph that computes forces from it cannot work on a
/// real device. On a simulated device with a first mode, this node gives the position of the end of the structure, where the hand
/// holds it, while device.position gives that of the motor.
/// Only simulated devices provide it; it is 0 on other devices, and on a reading that is not valid or not finite.
struct DeviceTruth
{
    using Inputs = Empty;
    using Params = Empty;

    struct Outputs
    {
        Position position = Position::Zero();
        Vec3 velocity = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "device.truth",
        .name = "Truth",
        .summary = "True position and velocity of a simulated tool.",
        .source = "definition",
        .keywords = "simulation",
    };

    static constexpr std::tuple ports {
        output (&Outputs::position, "position", unit::metre, "position of the tool, not quantised"),
        output (&Outputs::velocity, "velocity", unit::speed, "velocity of the tool"),
    };

    Params params;

    void bind (const DeviceState& state) noexcept { device = &state; }

    Outputs tick (const Inputs&) const noexcept
    {
        const Reading& now = device->reading;
        if (! now.valid || ! isFinite (now.true_position, now.true_velocity)) return {};
        return { .position = now.true_position, .velocity = now.true_velocity };
    }

private:
    const DeviceState* device = &no_device;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceTruth);
