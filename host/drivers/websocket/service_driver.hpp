// SPDX-License-Identifier: MIT
#pragma once

#include "exchange.hpp"

#include <host/devices/device_plugins/driver_answer.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/result.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace tactus::host
{

/// The functions of a driver for devices behind a service. `Device` has
///
///     struct Settings;                                                              what the person asks for
///     static Result<Settings> read (const std::string& port, const Json&);
///     Device (Settings, const Exchange::Promises&);
///     static constexpr Exchange::Promises promises;
///     std::string open (tactus_device_about&);                                      why it cannot; empty if it can
///     int32_t next (Clock::time_point until, tactus_reading&, tactus_device_stamp&, std::string& why);
///     std::string take (const tactus_effort&);                                      why it cannot; empty if it can
///     void rest();
///
/// and promises that are so many times longer.
template <typename Device, int times>
struct ServiceDriver
{
    static Result<typename Device::Settings> settings (const tactus_device_description& given)
    {
        const auto* json = given.json != nullptr && given.json[0] != 0 ? given.json : "{}";
        return Device::read (given.port != nullptr ? given.port : "", readJson (json).root);
    }

    static int32_t check (const tactus_device_description* given, const tactus_plugin_report* report) noexcept
    {
        return answered (report, [&] {
            const auto read = settings (*given);
            return read ? int32_t { TACTUS_DEVICE_OK } : failed (report, read.error().text);
        });
    }

    static void* open (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report) noexcept
    {
        Device* opened = nullptr;
        answered (report, [&] {
            auto read = settings (*given);
            if (! read) return failed (report, read.error().text);
            auto device = std::make_unique<Device> (std::move (*read), Device::promises * times);
            if (const auto why = device->open (*about); ! why.empty()) return failed (report, why);
            opened = device.release();
            return int32_t { TACTUS_DEVICE_OK };
        });
        return opened;
    }

    static int32_t read (void* device, int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report) noexcept
    {
        return answered (report, [&] {
            std::string why;
            const auto got = static_cast<Device*> (device)->next (Exchange::Clock::now() + std::chrono::milliseconds (timeout_ms), *to, *stamp, why);
            if (got == TACTUS_DEVICE_GONE) failed (report, why);
            return got;
        });
    }

    static int32_t write (void* device, const tactus_effort* effort, const tactus_plugin_report* report) noexcept
    {
        return answered (report, [&] {
            const auto why = static_cast<Device*> (device)->take (*effort);
            return why.empty() ? int32_t { TACTUS_DEVICE_OK } : failed (report, why);
        });
    }

    static int32_t rest (void* device, const tactus_plugin_report* report) noexcept
    {
        return answered (report, [&] {
            static_cast<Device*> (device)->rest();
            return int32_t { TACTUS_DEVICE_OK };
        });
    }

    static void close (void* device) noexcept { delete static_cast<Device*> (device); }
};

/// The driver of these devices. `times`: its promises about a service that does not answer are so many times longer, for tests on busy computers.
template <typename Device, int times, std::size_t n>
constexpr tactus_device_driver serviceDriver (const char* name, const char* about, const char* const (&keys)[n])
{
    using Functions = ServiceDriver<Device, times>;
    return { sizeof (tactus_device_driver), TACTUS_DEVICE_ABI, name, "1.0.0", about, keys, n, Functions::check, Functions::open, Functions::read,
             Functions::write, Functions::rest, Functions::close, nullptr };
}

}   // namespace tactus::host
