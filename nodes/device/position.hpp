// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// Where the hand enters the graph: position and rotation of the tool as the device measures them.
///
/// The position is quantised as the device's encoders are. While the device has nothing to say, position and rotation
/// stay at the last valid reading, so that a dropped packet moves nothing; `valid` and `age` tell. Before the first
/// valid reading they are 0. A reading that is not finite is none: to put the tool at the origin for a tick would be a
/// stroke through the world, and a hit at its end.
struct DevicePosition
{
    struct Inputs
    {
    };

    struct Params
    {
    };

    struct Outputs
    {
        Vec3 position = Vec3::Zero();
        Vec3 rotation = Vec3::Zero();
        double valid = 0.0;
        double age = 0.0;
    };

    static constexpr Info info {
        .id = "device.position",
        .name = "Position",
        .summary = "Position and rotation of the tool, as the device measures them.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        output (&Outputs::position, "position", unit::metre, "of the tool: x right, y away, z up"),
        output (&Outputs::rotation, "rotation", unit::radian, "of the tool, axis times angle"),
        output (&Outputs::valid, "valid", unit::state, "1 while the device measures, else 0"),
        output (&Outputs::age, "age", unit::second, "since the device took the reading"),
    };

    Params params;

    void bind (const DeviceState& state) noexcept { device = &state; }

    Outputs tick (const Inputs&) noexcept
    {
        const Reading& now = device->reading;
        const bool tells = now.valid && isFinite (now.position, now.rotation, now.age);
        if (tells)
        {
            position = now.position;
            rotation = now.rotation;
        }
        return { .position = position, .rotation = rotation, .valid = tells ? 1.0 : 0.0, .age = finiteOrZero (now.age) };
    }

private:
    inline static const DeviceState absent { .reading = { .valid = false }, .applied = {} };
    const DeviceState* device = &absent;
    Vec3 position = Vec3::Zero(), rotation = Vec3::Zero();   // last valid
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DevicePosition);
