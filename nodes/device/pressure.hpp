// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// How hard the hand presses or squeezes: a pen's tip, a gripper's handle, a force plate.
///
/// While the device has nothing to say the last valid reading stays, as in device.position, whose `valid` and `age`
/// tell. Devices without such a sensor give 0, and so does a reading that is not finite, which is not kept.
struct DevicePressure
{
    struct Inputs
    {
    };

    struct Params
    {
    };

    struct Outputs
    {
        double force = 0.0;
    };

    static constexpr Info info {
        .id = "device.pressure",
        .name = "Pressure",
        .summary = "How hard the hand presses.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        output (&Outputs::force, "force", unit::newton, "force of the hand on the sensor"),
    };

    Params params;

    void bind (const DeviceState& state) noexcept { device = &state; }

    Outputs tick (const Inputs&) noexcept
    {
        const Reading& now = device->reading;
        if (! isFinite (now.pressure)) return {};
        if (now.valid) force = now.pressure;
        return { .force = force };
    }

private:
    inline static const DeviceState absent {};
    const DeviceState* device = &absent;
    double force = 0.0;   // N, last valid
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DevicePressure);
