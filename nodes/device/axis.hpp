// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device_parts.hpp>
#include <tactus/node/generic.hpp>

#include <string>

namespace tactus::nodes
{

/// One axis of the device other than the tool: a trigger, a thumb stick, a joint of a glove, a wheel.
///
/// Its unit is the device's: m, rad, or fractions of the whole travel. While the device gives no valid reading, the last valid one is
/// kept, as in device.position. It gives 0 on a device without such an axis, with a warning when the run is set up, and on a
/// reading that is not finite, which is not kept.
struct DeviceAxis
{
    using Inputs = Empty;
    using Params = Empty;

    struct Settings
    {
        std::string axis;
    };

    struct Outputs
    {
        double axis = 0.0;
    };

    static constexpr Info info {
        .id = "device.axis",
        .name = "Axis",
        .summary = "Position of one axis of the device.",
        .source = "definition",
        .keywords = "encoder joint angle input",
    };

    static constexpr std::tuple ports {
        setting (&Settings::axis, "axis", unit::count, "name of the axis on the device"),
        output (&Outputs::axis, "axis", any_unit, "position of the axis, in m, in rad, or as a fraction of the whole travel"),
    };

    Params params;
    Settings settings;

    void bind (const DeviceState& state) noexcept
    {
        device = &state;
        index = partNamed (settings.axis, state.layout.axes);
    }

    std::string missing (const DeviceLayout& device_has) const { return lacking ("axis", "axes", settings.axis, device_has.axes); }

    Outputs tick (const Inputs&) noexcept
    {
        const Reading& now = device->reading;
        const double reads = now.axes[index];
        if (! isFinite (reads)) return {};
        if (now.valid) value = reads;
        return { .axis = value };
    }

    void serialize (auto& archive) { archive (value); }

private:
    const DeviceState* device = &no_device;
    int index = -1;
    double value = 0.0;   // the last valid value
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceAxis);
