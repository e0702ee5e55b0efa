// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

namespace tactus::nodes
{

/// Where a simulated tool really is, before its encoders round it, and how fast it moves.
///
/// For plots and tests, and to see what resolution costs: a graph that feels with it has no real counterpart. Only
/// simulated devices know; of others it is 0. It is 0 also on a reading that is not valid or not finite.
struct DeviceTruth
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
        Vec3 velocity = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "device.truth",
        .name = "Truth",
        .summary = "True position and velocity of a simulated tool.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        output (&Outputs::position, "position", unit::metre, "of the tool, not quantised"),
        output (&Outputs::velocity, "velocity", unit::speed, "of the tool"),
    };

    Params params;

    void bind (const DeviceState& state) noexcept { device = &state; }

    Outputs tick (const Inputs&) noexcept
    {
        const Reading& now = device->reading;
        if (! now.valid || ! isFinite (now.true_position, now.true_velocity)) return {};
        return { .position = now.true_position, .velocity = now.true_velocity };
    }

private:
    inline static const DeviceState absent {};
    const DeviceState* device = &absent;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceTruth);
