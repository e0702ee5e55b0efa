// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// The force with which the hand presses or squeezes: a pen's tip, a gripper's handle, a force plate.
///
/// While the device gives no valid reading, the last valid one is kept, as in device.position, whose `valid` and `age` report
/// this. It gives 0 on devices without such a sensor, and on a reading that is not finite, which is not kept.
struct DevicePressure
{
    using Inputs = Empty;
    using Params = Empty;

    struct Outputs
    {
        double force = 0.0;
    };

    static constexpr Info info {
        .id = "device.pressure",
        .name = "Pressure",
        .summary = "How hard the hand presses.",
        .source = "definition",
        .keywords = "pen input sensor",
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

    void serialize (auto& archive) { archive (force); }

private:
    const DeviceState* device = &no_device;
    double force = 0.0;   // the last valid value, in N
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DevicePressure);
