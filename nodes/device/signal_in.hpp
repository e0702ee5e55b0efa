// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device_parts.hpp>
#include <tactus/node/generic.hpp>

#include <string>

namespace tactus::nodes
{

/// The signal of one sensor channel of the device: an accelerometer at the tip, a contact microphone, a force cell.
///
/// Its unit depends on the channel's calibration. It gives 0 on a device without such a channel, with a warning when the run
/// is set up; while the device gives no valid reading; and on a value that is not finite. A signal is not held.
///
/// Good to know
///  - One sample per tick: unless the device filters the signal, everything above half the graph's rate aliases.
struct DeviceSignalIn
{
    using Inputs = Empty;
    using Params = Empty;

    struct Settings
    {
        int channel = 1;
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "device.signal_in",
        .name = "Signal in",
        .summary = "The signal of a sensor channel of the device.",
        .source = "definition",
        .keywords = "sensor microphone input",
    };

    static constexpr std::tuple ports {
        setting (&Settings::channel, "channel", unit::count, "number of the channel, from 1", { .hard = { 1, Channels::most }, .usual = { 1, 8 } }),
        output (&Outputs::out, "out", any_unit, "signal: N, m/s2 or 1, as the channel is calibrated"),
    };

    Params params;
    Settings settings;

    void bind (const DeviceState& state) noexcept { device = &state; }

    std::string missing (const DeviceLayout& device_has) const { return lackingChannel ("signal input", settings.channel, device_has.signal_inputs); }

    Outputs tick (const Inputs&) const noexcept
    {
        const Reading& now = device->reading;
        return { .out = now.valid ? finiteOrZero (now.signals[settings.channel - 1]) : 0.0 };
    }

private:
    const DeviceState* device = &no_device;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceSignalIn);
