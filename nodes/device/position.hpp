// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Position and rotation of the tool as the device measures them. This is where the hand enters the graph.
///
/// The position is quantised by the device's encoders. While the device gives no valid reading, position and rotation stay at the
/// last valid one, so that a dropped packet moves nothing; `valid` and `age` report this. Before the first valid reading they are
/// 0. A reading that is not finite is ignored: a tool that jumped to the origin for one tick would seem to fly across the world,
/// and to hit something at the end.
struct DevicePosition
{
    using Inputs = Empty;
    using Params = Empty;

    struct Outputs
    {
        Position position = Position::Zero();
        Vec3 rotation = Vec3::Zero();
        double valid = 0.0;
        double age = 0.0;
    };

    static constexpr Info info {
        .id = "device.position",
        .name = "Position",
        .summary = "Position and rotation of the tool, as the device measures them.",
        .source = "definition",
        .keywords = "hand mouse pen stylus tool cursor input source",
    };

    static constexpr std::tuple ports {
        output (&Outputs::position, "position", unit::metre, "position of the tool: x right, y away, z up"),
        output (&Outputs::rotation, "rotation", unit::radian, "rotation of the tool: axis times angle"),
        output (&Outputs::valid, "valid", unit::state, "1 while the device gives a valid reading, else 0"),
        output (&Outputs::age, "age", unit::second, "time since the device took the reading"),
    };

    Params params;

    void bind (const DeviceState& state) noexcept { device = &state; }

    Outputs tick (const Inputs&) noexcept
    {
        const Reading& now = device->reading;
        const bool tells = now.valid && isFinite (now.position, now.rotation, now.age);
        if (! tells) return { .position = position, .rotation = rotation, .valid = 0.0, .age = finiteOrZero (now.age) };
        position = now.position;
        rotation = now.rotation;
        return { .position = now.position, .rotation = now.rotation, .valid = 1.0, .age = now.age };
    }

    void serialize (auto& archive) { archive (position, rotation); }

private:
    const DeviceState* device = &no_device;
    // The last valid values.
    Position position = Position::Zero();
    Vec3 rotation = Vec3::Zero();
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DevicePosition);
