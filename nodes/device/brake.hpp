// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <string>

namespace tactus::nodes
{

/// Brakes the tool of a device that has a brake: a magneto-rheological or eddy-current brake. The hand feels a thick liquid that can
/// become so stiff that a wall stops buzzing.
///
///     B = max (0, damping) + max (0, stiffness) T / 2         T: time of a tick; B: damping on the tool
///
/// `stiffness` is that of what the graph renders. A force that is held for a tick leaks at most K dp^2 / 2 of energy in a movement dp, and
/// a brake of K T / 2 takes as much. So a wall whose local stiffness is wired here stays passive even if the device alone is too light
/// for it. Several brakes of one role add up. The role's guard limits the sum, and on a value that is not a number it stops the role;
/// `applied` shows what reached the brake on the last tick. On a device without a brake it has no effect, with a warning when the run is
/// set up.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), sections 1 and 7: B (t) >= sigma (d, t) T / 2; Colgate and Brown 1994.
///
/// Good to know
///  - A brake only takes energy, so no graph can make it push. It cannot hold the tool in place either: its force is 0 at rest.
///  - Switch it on before the touch, by the way of at least one tick: in the tick that enters a wall, a movement leaks too. signal.map of
///    the depth does this.
///  - A brake takes time to build up its field. Leave a margin.
struct DeviceBrake
{
    struct Inputs
    {
        double damping = 0.0;
        double stiffness = 0.0;
    };

    using Params = Empty;

    struct Outputs
    {
        double applied = 0.0;
    };

    static constexpr Info info {
        .id = "device.brake",
        .name = "Brake",
        .summary = "Brakes the tool, through the guard.",
        .source = "Hayward 2007, sections 1 and 7; Colgate & Brown 1994",
        .keywords = "damper dissipative magneto-rheological eddy current passive output sink",
    };

    static constexpr std::tuple ports {
        input (&Inputs::damping, "damping", unit::damping, "damping of the brake; below 0 counts as 0"),
        input (&Inputs::stiffness, "stiffness", unit::stiffness,
               "stiffness to make up for: half of it, times the time of a tick, is added; below 0 counts as 0"),
        output (&Outputs::applied, "applied", unit::damping, "damping of the brake since the last tick, after the limits of the guard"),
    };

    Params params;

    void prepare (const Setup& setup) noexcept { half_tick = 0.5 * setup.dt_s(); }

    void bind (const DeviceState& state) noexcept
    {
        device = &state;
        is_there = state.layout.brake > 0.0;
    }

    std::string missing (const DeviceLayout& device_has) const { return device_has.brake > 0.0 ? "" : "no brake"; }

    Outputs peek() const noexcept { return { .applied = device->applied.brake }; }

    void tick (const Inputs& in) noexcept { wanted = notNegative (in.damping) + half_tick * notNegative (in.stiffness); }

    Effort effort() const noexcept
    {
        Effort all;
        if (is_there) all.brake = wanted;
        return all;
    }

    void serialize (auto& archive) { archive (wanted); }

private:
    static double notNegative (double v) noexcept { return v < 0.0 ? 0.0 : v; }   // what is not a number goes to the guard

    const DeviceState* device = &no_device;
    bool is_there = false;
    double wanted = 0.0, half_tick = 0.0;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceBrake);
