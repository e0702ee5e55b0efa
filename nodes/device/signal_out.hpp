// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device_parts.hpp>
#include <tactus/node/generic.hpp>

#include <string>

namespace tactus::nodes
{

/// Sends a signal to one of the device's vibration channels: a voice coil, a linear resonant actuator, a tactor.
///
/// Its unit depends on the channel's calibration: N, m/s2, or 1 at full scale. Several signals on one channel add up, and the
/// role's guard limits the sum. On a device without such a channel it has no effect, with a warning when the run is set up.
///
/// Good to know
///  - One sample per tick: everything above half the graph's rate aliases.
struct DeviceSignalOut
{
    using Inputs = In<double>;

    using Params = Empty;

    struct Settings
    {
        int channel = 1;
    };

    using Outputs = Empty;

    static constexpr Info info {
        .id = "device.signal_out",
        .name = "Signal out",
        .summary = "Sends a signal to a vibration channel of the device, through the guard.",
        .source = "definition",
        .keywords = "motor actuator voice coil speaker output",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit_adding, "signal: N, m/s2 or 1, as the channel is calibrated"),
        setting (&Settings::channel, "channel", unit::count, "number of the channel, from 1", { .hard = { 1, Channels::most }, .usual = { 1, 8 } }),
    };

    Params params;
    Settings settings;

    void bind (const DeviceState& state) noexcept { is_there = settings.channel <= state.layout.signal_outputs; }

    std::string missing (const DeviceLayout& device_has) const { return lackingChannel ("signal output", settings.channel, device_has.signal_outputs); }

    Outputs tick (const Inputs& in) noexcept
    {
        wanted = in.in;
        return {};
    }

    Effort effort() const noexcept
    {
        Effort all;
        if (is_there) all.signals.set (settings.channel - 1, wanted);
        return all;
    }

    void serialize (auto& archive) { archive (wanted); }

private:
    bool is_there = false;
    double wanted = 0.0;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceSignalOut);
