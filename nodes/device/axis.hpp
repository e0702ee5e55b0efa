// SPDX-License-Identifier: MIT
#pragma once

#include <framework/device_parts.hpp>
#include <framework/node.hpp>

#include <string>

namespace tactus::nodes
{

/// One axis of the device beside the tool: a trigger, a thumb stick, a joint of a glove, a wheel.
///
/// Its unit is that of the device: m, rad, or 1 from end to end. While the device has nothing to say the last valid reading
/// stays, as in device.position. A device without such an axis gives 0, with a warning when the run is set up, and so
/// does a reading that is not finite, which is not kept.
struct DeviceAxis
{
    struct Inputs
    {
    };

    struct Params
    {
    };

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
        .summary = "Where one axis of the device stands.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        setting (&Settings::axis, "axis", unit::count, "its name, as the device calls it"),
        output (&Outputs::axis, "axis", any_unit, "where it stands: m, rad, or 1 from end to end"),
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

private:
    inline static const DeviceState absent {};
    const DeviceState* device = &absent;
    int index = -1;
    double value = 0.0;   // last valid
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceAxis);
