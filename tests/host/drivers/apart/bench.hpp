// SPDX-License-Identifier: MIT
#pragma once

#include "../exercise.hpp"
#include "support/waiting.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <utility>

namespace tactus::test
{

/// A device, opened by a driver, with one tick after another.
class ApartBench
{
public:
    explicit ApartBench (const tactus_device_driver& d) : driver (d) {}

    bool opens (Json description = Json::object())
    {
        description["driver"] = driver.name;
        messages.clear();
        device.reset();
        const auto loaded = host::DeviceDriver::within (driver);
        REQUIRE (loaded);
        auto opened = (*loaded)->open (description, messages);
        if (! opened) return false;
        about = opened->about();
        host::PluginDevice::Options options { .silence_s = 60.0, .look_again = std::chrono::milliseconds (2), .patience = std::chrono::minutes (1) };
        options.real_time = false;
        device = std::make_unique<host::PluginDevice> (std::move (opened), std::nullopt, options);
        device->prepare (1e-3);
        return true;
    }

    static Effort along (int axis, double newtons = 1.0)
    {
        Effort effort;
        effort.force[axis] = newtons;
        return effort;
    }

    template <typename F>
    bool ticksUntil (F&& so, const Effort& effort = {})
    {
        return eventually ([&] {
            reading = device->read();
            device->write (reading.valid ? effort : Effort {});
            return so();
        });
    }

    /// The tool goes to this place, in m.
    bool reaches (const Vec3& place, const Effort& effort = {})
    {
        return ticksUntil ([&] { return reading.valid && (reading.position - place).norm() < 1e-4; }, effort);
    }

    bool tells (ReadingFault fault, const Effort& effort = along (2))
    {
        return ticksUntil ([&] { return reading.fault == fault; }, effort);
    }

    /// A force of 1 N moves the tool that way, and no other way, by more than half of what the stiffness of the hand allows: a busy computer takes it off
    /// now and then. In m, N/m.
    bool isPushed (const Vec3& middle, double stiffness)
    {
        bool is = reaches (middle);
        for (int axis = 0; axis < 3; ++axis)
            for (const double newtons : { 1.0, -1.0 })
            {
                const auto has_moved = [&] {
                    Vec3 by = (reading.position - middle) * stiffness / newtons;
                    const double along = std::exchange (by[axis], 0.0);
                    return reading.valid && along > 0.5 && by.norm() < 0.1;
                };
                is = ticksUntil (has_moved, along (axis, newtons)) && is;
            }
        return reaches (middle) && is;
    }

    const tactus_device_driver& driver;
    Messages messages;
    host::DriverAbout about;
    std::unique_ptr<host::PluginDevice> device;
    Reading reading;
};

}   // namespace tactus::test
