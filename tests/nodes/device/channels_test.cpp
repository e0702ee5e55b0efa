// SPDX-License-Identifier: MIT
// Axes, buttons and signals of a device, by name and by number.

#include <tactus/nodes/device/axis.hpp>
#include <tactus/nodes/device/button.hpp>
#include <tactus/nodes/device/effort.hpp>
#include <tactus/nodes/device/signal_in.hpp>
#include <tactus/nodes/device/signal_out.hpp>

#include <catch2/catch.hpp>

using namespace tactus::nodes;
using tactus::Channels;
using tactus::DeviceLayout;
using tactus::DeviceState;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const DeviceLayout pad { .axes = { "stick", "trigger" }, .efforts = { "trigger" }, .buttons = { "cross", "", "0" }, .signal_inputs = 1, .signal_outputs = 2 };

DeviceState padState()
{
    DeviceState state;
    state.layout = pad;
    return state;
}
}   // namespace

TEST_CASE ("device: an axis is found by name, and keeps its value while the device is silent", "[nodes][device]")
{
    auto device = padState();
    DeviceAxis node;
    node.settings.axis = "trigger";
    node.bind (device);
    CHECK (node.tick ({}).axis == 0.0);

    device.reading.axes = { 0.25, 0.75 };
    CHECK (node.tick ({}).axis == 0.75);
    device.reading.axes = { 0.0, not_a_number };
    CHECK (node.tick ({}).axis == 0.0);
    device.reading = { .valid = false };
    CHECK (node.tick ({}).axis == 0.75);

    CHECK (node.missing (pad).empty());
    CHECK (node.missing ({}) == "no axis 'trigger'; it has no axes at all");
    node.settings.axis = "triger";
    CHECK (node.missing (pad) == "no axis 'triger' (did you mean 'trigger'?); its axes: 'stick', 'trigger'");
    node.bind (device);
    device.reading = { .axes = { 0.25, 0.5 } };
    DeviceAxis fresh;
    fresh.settings.axis = "triger";
    fresh.bind (device);
    CHECK (fresh.tick ({}).axis == 0.0);
}

TEST_CASE ("device: an effort goes to the axis of its name, or nowhere if that axis cannot be pushed", "[nodes][device]")
{
    const auto device = padState();
    DeviceEffort node;
    node.settings.axis = "trigger";
    node.bind (device);
    node.tick ({ .effort = -2.0 });
    CHECK (node.effort().axes.size() == 1);
    CHECK (node.effort().axes[0] == -2.0);
    CHECK (node.effort().force.isZero (0.0));
    CHECK (node.missing (pad).empty());

    node.settings.axis = "stick";   // can only be read
    node.bind (device);
    CHECK (node.effort().axes.size() == 0);
    CHECK (node.missing (pad) == "no driven axis 'stick'; its driven axes: 'trigger'");
}

TEST_CASE ("device: a button is found by name or by number", "[nodes][device]")
{
    auto device = padState();
    device.reading.buttons = 2;
    const auto pressed = [&] (const char* button) {
        DeviceButton node;
        node.settings.button = button;
        node.bind (device);
        return node.tick ({}).pressed == 1.0;
    };
    CHECK_FALSE (pressed ("cross"));
    CHECK (pressed ("1"));
    CHECK_FALSE (pressed ("0"));   // "0" is the name of button 2
    CHECK_FALSE (pressed ("3"));
    CHECK_FALSE (pressed (""));   // a button without a name is not found by the empty name
    device.reading.buttons = 5;
    CHECK (pressed ("cross"));
    CHECK (pressed ("0"));

    DeviceButton held;
    held.settings.button = "cross";
    held.bind (device);
    CHECK (held.tick ({}).pressed == 1.0);
    device.reading = { .valid = false };
    CHECK (held.tick ({}).pressed == 1.0);
    device.reading = {};
    CHECK (held.tick ({}).pressed == 0.0);

    const auto missing = [] (const char* button) {
        DeviceButton node;
        node.settings.button = button;
        return node.missing (pad);
    };
    CHECK (missing ("1").empty());
    CHECK (missing ("cross").empty());
    CHECK (missing ("7") == "no button 7; it has 3, counted from 0");
    CHECK (missing ("circle") == "no button 'circle'; its buttons: 'cross', '0'");
    CHECK_FALSE (missing ("").empty());
}

TEST_CASE ("device: signals are numbered by channel, from 1", "[nodes][device]")
{
    auto device = padState();
    DeviceSignalIn in;
    in.bind (device);
    device.reading.signals = { 3.0, 4.0 };
    CHECK (in.tick ({}).out == 3.0);
    device.reading.signals = { not_a_number };
    CHECK (in.tick ({}).out == 0.0);
    device.reading = { .valid = false, .signals = { 3.0 } };
    CHECK (in.tick ({}).out == 0.0);
    CHECK (in.missing (pad).empty());
    in.settings.channel = 2;
    CHECK (in.missing (pad) == "no signal input 2; it has 1");

    DeviceSignalOut out;
    out.settings.channel = 2;
    out.bind (device);
    out.tick ({ .in = 0.5 });
    CHECK (out.effort().signals.size() == 2);
    CHECK (out.effort().signals[1] == 0.5);
    CHECK (out.effort().signals[0] == 0.0);
    out.settings.channel = 3;
    out.bind (device);
    CHECK (out.effort().signals.size() == 0);
    CHECK (out.missing (pad) == "no signal output 3; it has 2");
}

TEST_CASE ("channels hold the values that were set, and 0 beyond", "[framework]")
{
    Channels all { 1.0, 2.0 };
    all.set (4, 5.0);
    CHECK (all.size() == 5);
    CHECK (all[1] == 2.0);
    CHECK (all[3] == 0.0);
    CHECK (all[5] == 0.0);
    CHECK (all[-1] == 0.0);
    all.set (-1, 9.0);
    all.set (Channels::most, 9.0);
    CHECK (all.size() == 5);
    const auto copy = all;
    CHECK (std::equal (copy.begin(), copy.end(), all.begin(), all.end()));
    all = {};
    CHECK (all.size() == 0);
    CHECK (copy[4] == 5.0);
    CHECK_FALSE (tactus::isFinite (Channels { 1.0, not_a_number }));
}
