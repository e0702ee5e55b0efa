// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The force and torque that a device applies to the tool in the hand. This is where forces leave the graph.
///
/// Several sinks of one role add up. The sum always goes through the role's guard; `applied` shows the force that reached the motors
/// on the last tick, after the limits of the guard and of the motors. On a non-finite value the guard brings the device to zero.
struct DeviceForce
{
    struct Inputs
    {
        Vec3 force = Vec3::Zero();
        Vec3 torque = Vec3::Zero();
    };

    using Params = Empty;

    struct Outputs
    {
        Vec3 applied = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "device.force",
        .name = "Force",
        .summary = "Sends a force and a torque to the device, through the guard.",
        .source = "definition",
        .keywords = "motor actuator output sink",
    };

    static constexpr std::tuple ports {
        input (&Inputs::force, "force", unit::newton, "force on the tool"),
        input (&Inputs::torque, "torque", unit::torque, "torque on the tool"),
        output (&Outputs::applied, "applied", unit::newton, "force on the tool since the last tick, after the limits of the guard and of the motors"),
    };

    Params params;

    void bind (const DeviceState& state) noexcept { device = &state; }
    Outputs peek() const noexcept { return { .applied = device->applied.force }; }
    void tick (const Inputs& in) noexcept { wanted = in; }
    Effort effort() const noexcept { return { wanted.force, wanted.torque }; }

    void serialize (auto& archive) { archive (wanted); }

private:
    const DeviceState* device = &no_device;
    Inputs wanted;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceForce);
