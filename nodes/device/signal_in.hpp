// SPDX-License-Identifier: MIT
#pragma once

#include <framework/device_parts.hpp>
#include <framework/node.hpp>

#include <string>

namespace tactus::nodes
{

/// What one of the device's sensor channels hears: an accelerometer at the tip, a contact microphone, a force cell.
///
/// What it is in depends on how the channel is calibrated. A device without such a channel gives 0, with a warning when the
/// run is set up, and so does a device that has nothing to say and a value that is not finite: a signal is not held.
///
/// Good to know
///  - One sample a tick: unless the device filters it, what is above half the rate of the graph folds back.
struct DeviceSignalIn
{
    struct Inputs
    {
    };

    struct Params
    {
    };

    struct Settings
    {
        int channel = 1;
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "device.signal_in",
        .name = "Signal in",
        .summary = "What a sensor channel of the device hears.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        setting (&Settings::channel, "channel", unit::count, "which one, from 1", { .hard = { 1, Channels::most }, .usual = { 1, 8 } }),
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
    inline static const DeviceState absent {};
    const DeviceState* device = &absent;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceSignalIn);
