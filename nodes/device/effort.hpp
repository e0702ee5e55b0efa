// SPDX-License-Identifier: MIT
#pragma once

#include <framework/device_parts.hpp>
#include <framework/node.hpp>

#include <string>

namespace tactus::nodes
{

/// Pushes one axis of the device beside the tool: a trigger, a wheel, a joint of an exoskeleton.
///
/// In N for an axis that slides, in N m for one that turns; positive drives it to larger values of device.axis. Several
/// efforts on one axis add up, and the role's guard limits the sum, as for device.force. On a device without such an axis
/// it acts on nothing, with a warning when the run is set up.
struct DeviceEffort
{
    struct Inputs
    {
        double effort = 0.0;
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
    };

    static constexpr Info info {
        .id = "device.effort",
        .name = "Effort",
        .summary = "Pushes one axis of the device, through the guard.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::effort, "effort", any_unit_adding, "on the axis: N where it slides, N m where it turns"),
        setting (&Settings::axis, "axis", unit::count, "its name, as the device calls it"),
    };

    Params params;
    Settings settings;

    void bind (const DeviceState& state) noexcept { index = partNamed (settings.axis, state.layout.efforts); }

    std::string missing (const DeviceLayout& device_has) const { return lacking ("axis to push called", "axes to push", settings.axis, device_has.efforts); }

    Outputs tick (const Inputs& in) noexcept
    {
        wanted = in.effort;
        return {};
    }

    Effort effort() const noexcept
    {
        Effort all;
        all.axes.set (index, wanted);
        return all;
    }

private:
    int index = -1;
    double wanted = 0.0;   // N or N m
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceEffort);
