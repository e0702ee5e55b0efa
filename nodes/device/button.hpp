// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device_parts.hpp>
#include <tactus/node/generic.hpp>

#include <charconv>
#include <string>

namespace tactus::nodes
{

/// A button of the device, by name or by number.
///
/// While the device gives no valid reading, the last valid one is kept, as in device.position. It gives 0 on a device without
/// such a button, with a warning when the run is set up.
struct DeviceButton
{
    using Inputs = Empty;
    using Params = Empty;

    struct Settings
    {
        std::string button = "0";
    };

    struct Outputs
    {
        double pressed = 0.0;
    };

    static constexpr Info info {
        .id = "device.button",
        .name = "Button",
        .summary = "Whether a button of the device is held down.",
        .source = "definition",
        .keywords = "switch click input",
    };

    static constexpr std::tuple ports {
        setting (&Settings::button, "button", unit::count, "name of the button on the device, or its number from 0"),
        output (&Outputs::pressed, "pressed", unit::state, "1 while it is held down, else 0"),
    };

    Params params;
    Settings settings;

    void bind (const DeviceState& state) noexcept
    {
        device = &state;
        index = find (state.layout);
    }

    std::string missing (const DeviceLayout& device_has) const
    {
        if (find (device_has) >= 0) return {};
        if (const int wanted = number(); wanted >= 0)
        {
            const auto count = device_has.buttons.size();
            return "no button " + std::to_string (wanted) + "; it has " + (count == 0 ? "none at all" : std::to_string (count) + ", counted from 0");
        }
        return lacking ("button", "buttons", settings.button, device_has.buttons);
    }

    Outputs tick (const Inputs&) noexcept
    {
        const Reading& now = device->reading;
        if (now.valid) is_held = index >= 0 && (now.buttons >> index & 1u) != 0;
        return { .pressed = is_held ? 1.0 : 0.0 };
    }

    void serialize (auto& archive) { archive (is_held); }

private:
    /// Bit of the button, or -1 if the device does not have it. A button whose name looks like a number is found by name.
    int find (const DeviceLayout& device_has) const noexcept
    {
        int at = partNamed (settings.button, device_has.buttons);
        if (at < 0) at = number();
        return at < static_cast<int> (device_has.buttons.size()) && at < Reading::most_buttons ? at : -1;
    }

    /// The setting as a number; -1 if it is a name.
    int number() const noexcept
    {
        const auto& text = settings.button;
        int n = -1;
        const auto [end, failure] = std::from_chars (text.data(), text.data() + text.size(), n);
        return failure == std::errc() && end == text.data() + text.size() ? n : -1;
    }

    const DeviceState* device = &no_device;
    int index = -1;
    bool is_held = false;   // the last valid value
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeviceButton);
