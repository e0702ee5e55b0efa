// SPDX-License-Identifier: MIT
// The driver of event devices, with a stick that moves by itself. Tests of the window open it as they would open the real one.

#include <host/drivers/evdev/driver.hpp>

#include <chrono>
#include <thread>

using namespace tactus;

namespace
{
constexpr int largest = 65535;

host::evdev::EventDeviceInfo stick()
{
    host::evdev::EventDeviceInfo info;
    info.path = "/dev/null";   // where the failsafe writes
    info.name = "Moving stick";
    info.has_constant = info.has_gain = info.may_open = true;
    info.axes = { { .code = ABS_X, .name = "x", .minimum = 0, .maximum = largest, .value = largest / 2 } };
    info.buttons = { { .code = BTN_TRIGGER, .name = "trigger" } };
    info.update_interval_s = 0.004;
    return info;
}

/// Goes from the middle to the right and back, in steps of a thousandth of its travel, one every 2 ms.
class MovingStick final : public host::evdev::EventDevice
{
public:
    const host::evdev::EventDeviceInfo& info() const noexcept override { return about; }

    Got next (Event& to, int) override
    {
        if (is_moved)
            to = { .type = EV_SYN, .code = SYN_REPORT };
        else
        {
            std::this_thread::sleep_for (std::chrono::milliseconds (2));
            constexpr int there = 200;
            const int at = steps++ % (2 * there);
            to = { .type = EV_ABS, .code = ABS_X, .value = largest / 2 + largest / 1000 * (at < there ? at : 2 * there - at) };
        }
        is_moved = ! is_moved;
        return Got::event;
    }

    int upload (ff_effect& effect) override
    {
        effect.id = 0;
        return 0;
    }
    int tell (std::uint16_t, int) override { return 0; }

private:
    const host::evdev::EventDeviceInfo about = stick();
    bool is_moved = false;
    int steps = 0;
};

class OneStick final : public host::evdev::EventSystem
{
public:
    std::vector<host::evdev::EventDeviceInfo> list() override { return { stick() }; }
    Result<std::unique_ptr<host::evdev::EventDevice>> open (const std::string&) override
    {
        return std::unique_ptr<host::evdev::EventDevice> (std::make_unique<MovingStick>());
    }
};

struct Use
{
    Use() { host::evdev::setSystem (stick); }
    OneStick stick;
} use;
}   // namespace

extern "C" const tactus_device_driver tactus_device_entry = host::evdev::driver;
