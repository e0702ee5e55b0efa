// SPDX-License-Identifier: MIT
#pragma once

#include <host/drivers/evdev/force_device.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

namespace tactus::fuzz
{

/// An event device that sends what bytes say, and checks what it is told.
class BytesAsEvents final : public host::evdev::EventDevice
{
public:
    BytesAsEvents (std::string_view b, bool has_constant) : bytes (b)
    {
        about.name = "Fuzzed";
        about.has_constant = has_constant;
        about.has_rumble = true;
        about.axes = { { .code = ABS_X, .name = "x", .minimum = -100, .maximum = 100 }, { .code = ABS_Y, .name = "y", .minimum = 0, .maximum = 65535 } };
        about.buttons = { { .code = BTN_TRIGGER, .name = "trigger" } };
    }

    const host::evdev::EventDeviceInfo& info() const noexcept override { return about; }

    Got next (Event& to, int) override
    {
        constexpr std::size_t size = 8;
        if (bytes.size() < size) return bytes.empty() || bytes.size() % 2 == 0 ? Got::gone : Got::nothing;
        std::uint16_t code = 0;
        std::int32_t value = 0;
        std::memcpy (&code, bytes.data() + 1, sizeof code);
        std::memcpy (&value, bytes.data() + 3, sizeof value);
        const auto type = static_cast<std::uint8_t> (bytes[0]);
        const auto pause = static_cast<std::uint8_t> (bytes[7]);
        bytes.remove_prefix (size);
        if (pause == 0xff) return Got::nothing;
        to = { .type = type, .code = code, .value = value, .age_s = 1e-3 * pause };
        return Got::event;
    }

    int upload (ff_effect& effect) override
    {
        if (effect.replay.length != 500) std::abort();
        if (effect.type == FF_CONSTANT && std::abs (int { effect.u.constant.level }) > 16384) std::abort();   // half of it may be used
        effect.id = 0;
        pushes = effect.type == FF_CONSTANT ? effect.u.constant.level != 0 : effect.u.rumble.strong_magnitude != 0 || effect.u.rumble.weak_magnitude != 0;
        return 0;
    }

    int tell (std::uint16_t, int) override { return 0; }

    bool pushes = false;

private:
    std::string_view bytes;
    host::evdev::EventDeviceInfo about;
};

/// Takes the bytes as events, and pushes with what is read. Readings are finite and of the device's own parts, and after a rest there is no force.
/// Aborts otherwise.
inline void tryEvents (std::string_view data)
{
    using host::evdev::ForceDevice;
    for (const bool is_wheel : { true, false })
    {
        auto events = std::make_unique<BytesAsEvents> (data, is_wheel);
        const auto& device = *events;
        ForceDevice force { std::move (events),
                            { .full_force = 4.0, .turns = data.size() % 2 == 0, .usable = 0.5, .travel = { { "x", 0.1 } } },
                            static_cast<double> (data.size() % 3) * 100.0 };
        if (! force.prepare().empty()) std::abort();
        ForceDevice::Clock::time_point now {};
        for (std::size_t i = 0; i <= data.size(); ++i)
        {
            tactus_reading reading {};
            tactus_device_stamp stamp = TACTUS_DEVICE_STAMP_INIT;
            const auto got = force.read (std::chrono::milliseconds (0), reading, stamp);
            if (got == TACTUS_DEVICE_GONE) break;
            if (got != TACTUS_DEVICE_OK && got != TACTUS_DEVICE_NONE) std::abort();
            if (reading.buttons > 1u || reading.axis_count > 2u || ! std::isfinite (stamp.reached_hz)) std::abort();
            tactus_effort effort {};
            for (int k = 0; k < 3; ++k)
            {
                if (! std::isfinite (reading.position[k]) || ! std::isfinite (reading.rotation[k])) std::abort();
                effort.force[k] = reading.position[k] * 1e3;
                effort.torque[k] = reading.rotation[k] * 1e3;
            }
            effort.signals[0] = reading.axes[0];
            effort.signals[1] = -reading.axes[1];
            now += std::chrono::milliseconds (1 + i % 7);
            if (force.write (effort, now) != 0) std::abort();
        }
        if (force.rest() != 0 || device.pushes) std::abort();
    }
}

}   // namespace tactus::fuzz
