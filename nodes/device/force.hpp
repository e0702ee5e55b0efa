// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// Where forces leave the graph: the force and torque a device puts on the tool in the hand.
///
/// Several sinks of one role add up. After the sum stands the role's guard, always; `applied` shows what it let
/// through on the last tick. A non-finite value makes
/// the guard bring the device to zero.
struct DeviceForce
{
    struct Inputs
    {
        Vec3 force = Vec3::Zero();
        Vec3 torque = Vec3::Zero();
    };

    struct Params
    {
    };

    struct Outputs
    {
        Vec3 applied = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "device.force",
        .name = "Force",
        .summary = "Sends a force and a torque to the device, through the guard.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::force, "force", unit::newton, "force on the tool"),
        input (&Inputs::torque, "torque", unit::torque, "torque on the tool"),
        output (&Outputs::applied, "applied", unit::newton, "force the guard let through on the last tick"),
    };

    Params params;

    void bind (const DeviceState& state) noexcept { device = &state; }
    Outputs peek() const noexcept { return { .applied = device->applied.force }; }
    void tick (const Inputs& in) noexcept { wanted = in; }
    Effort effort() const noexcept { return { wanted.force, wanted.torque }; }

private:
    inline static const DeviceState absent {};
    const DeviceState* device = &absent;
    Inputs wanted;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceForce);
