// SPDX-License-Identifier: MIT
#pragma once

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>
#include <host/drivers/openhaptics/fake_hd.hpp>
#include <host/drivers/openhaptics/touch.hpp>

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>

namespace tactus::test
{

using host::FakeTouches;

/// A computer with OpenHaptics, whose library is one of our fakes, and two arms in memory.
class TouchLab
{
public:
    /// `kind`: the folder of the fake; null: there is no library.
    explicit TouchLab (const char* kind = "hd")
    {
        const auto file = (folder / "arms").string();
        const int opened = ::open (file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        REQUIRE (opened >= 0);
        REQUIRE (::ftruncate (opened, sizeof (FakeTouches)) == 0);
        void* at = ::mmap (nullptr, sizeof (FakeTouches), PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
        ::close (opened);
        REQUIRE (at != MAP_FAILED);
        arms = static_cast<FakeTouches*> (at);
        ::setenv ("TACTUS_FAKE_HD", file.c_str(), 1);
        ::setenv ("HOME", folder.path().c_str(), 1);
        const auto libraries = kind != nullptr ? std::string (TACTUS_FAKE_LIBRARIES) + "/" + kind : folder.path().string();
        ::setenv ("LD_LIBRARY_PATH", libraries.c_str(), 1);
    }
    ~TouchLab()
    {
        arms->stall_ms = arms->stop_hangs = 0;
        device.reset();
        ::setenv ("HOME", home.c_str(), 1);
        ::unsetenv ("LD_LIBRARY_PATH");
        ::unsetenv ("TACTUS_FAKE_HD");
        ::munmap (arms, sizeof (FakeTouches));
    }
    TouchLab (const TouchLab&) = delete;
    TouchLab& operator= (const TouchLab&) = delete;

    FakeTouches::Arm& arm (int index = 0) const { return arms->arms[static_cast<std::size_t> (index)]; }

    static host::PluginDevice::Options patient()
    {
        return { .silence_s = 60.0, .look_again = std::chrono::milliseconds (2), .patience = std::chrono::minutes (1), .real_time = false };
    }

    bool opens (const std::string& port = {}, const host::PluginDevice::Options& options = patient())
    {
        messages.clear();
        device.reset();
        const auto driver = host::DeviceDriver::within (host::openhaptics::driver);
        REQUIRE (driver);
        Json description { { "driver", "openhaptics" } };
        if (! port.empty()) description["port"] = port;
        auto there = (*driver)->open (description, messages);
        UNSCOPED_INFO (text (messages));
        if (! there) return false;
        limits = there->about().limits;
        device_watchdog_s = there->about().device_watchdog_s;
        device = std::make_unique<host::PluginDevice> (std::move (there), std::nullopt, options);
        device->prepare (1e-3);
        return true;
    }

    std::string said (const std::string& port = {})
    {
        opens (port);
        return text (messages);
    }

    bool tick (const Effort& effort = {})
    {
        reading = device->read();
        device->write (reading.valid ? effort : Effort {});
        return reading.valid;
    }

    template <typename F>
    bool ticksUntil (F&& so, const Effort& effort = {})
    {
        return eventually ([&] {
            tick (effort);
            return so();
        });
    }

    /// True as soon as the arm feels 1 N upwards.
    bool pushes()
    {
        return ticksUntil ([&] { return arm().force[1] == 1.0; }, along (2));
    }

    static Effort along (int axis, double newtons = 1.0)
    {
        Effort effort;
        effort.force[axis] = newtons;
        return effort;
    }

    const std::string home = std::getenv ("HOME") != nullptr ? std::getenv ("HOME") : "";
    TemporaryFolder folder;
    FakeTouches* arms = nullptr;
    GuardLimits limits;
    double device_watchdog_s = 0.0;
    Messages messages;
    std::unique_ptr<host::PluginDevice> device;
    Reading reading;
};

}   // namespace tactus::test
