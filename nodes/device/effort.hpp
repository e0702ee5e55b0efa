// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device_parts.hpp>
#include <tactus/node/generic.hpp>

#include <string>

namespace tactus::nodes
{

/// Pushes one axis of the device other than the tool: a trigger, a wheel, a joint of an exoskeleton.
///
/// The unit is N for an axis that slides and N m for one that turns; a positive effort drives the axis to larger values of
/// device.axis. Several efforts on one axis add up, and the role's guard limits the sum, as for device.force. On a device
/// without such an axis it has no effect, with a warning when the run is set up.
///
/// A motor that renders the force at the tool cannot be pushed as an axis too: the guard would limit the two separately, but not
/// their sum.
struct DeviceEffort
{
    struct Inputs
    {
        double effort = 0.0;
    };

    using Params = Empty;

    struct Settings
    {
        std::string axis;
    };

    using Outputs = Empty;

    static constexpr Info info {
        .id = "device.effort",
        .name = "Effort",
        .summary = "Pushes one axis of the device, through the guard.",
        .source = "definition",
        .keywords = "motor torque joint output",
    };

    static constexpr std::tuple ports {
        input (&Inputs::effort, "effort", any_unit_adding, "effort on the axis: N if it slides, N m if it turns"),
        setting (&Settings::axis, "axis", unit::count, "name of the axis on the device"),
    };

    Params params;
    Settings settings;

    void bind (const DeviceState& state) noexcept { index = partNamed (settings.axis, state.layout.efforts); }

    std::string missing (const DeviceLayout& device_has) const { return lacking ("driven axis", "driven axes", settings.axis, device_has.efforts); }

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

    void serialize (auto& archive) { archive (wanted); }

private:
    int index = -1;
    double wanted = 0.0;   // N or N m
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceEffort);
