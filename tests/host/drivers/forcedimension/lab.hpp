// SPDX-License-Identifier: MIT
#pragma once

#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>
#include <host/drivers/forcedimension/arm.hpp>
#include <host/drivers/forcedimension/fake_drd.hpp>

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace tactus::test
{

using host::FakeArms;

/// A computer with the SDK of Force Dimension, whose library is one of our fakes, and two arms in memory.
class Lab
{
public:
    /// `name`: that of the file, "libdrd.so.3.17.5".
    explicit Lab (const char* fake = "libfake_drd.so", const std::string& name = "libdrd.so.3.17.5")
    {
        const auto file = (folder / "arms").string();
        const int opened = ::open (file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        REQUIRE (opened >= 0);
        REQUIRE (::ftruncate (opened, sizeof (FakeArms)) == 0);
        void* at = ::mmap (nullptr, sizeof (FakeArms), PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
        ::close (opened);
        REQUIRE (at != MAP_FAILED);
        arms = static_cast<FakeArms*> (at);
        for (auto& each : arms->arms)
            each.ignores_silence = 1;
        ::setenv ("TACTUS_FAKE_DRD", file.c_str(), 1);
        ::setenv ("FDSDK", (folder / "sdk").c_str(), 1);
        ::setenv ("HOME", folder.path().c_str(), 1);
        ::unsetenv ("FORCEDIM_SDK");
        if (fake != nullptr) install (fake, name);
    }
    ~Lab()
    {
        device.reset();
        ::setenv ("HOME", home.c_str(), 1);
        ::unsetenv ("FDSDK");
        ::unsetenv ("TACTUS_FAKE_DRD");
        // The memory stays: a call that hangs in the fake may still look at it.
    }
    Lab (const Lab&) = delete;
    Lab& operator= (const Lab&) = delete;

    void install (const char* fake, const std::string& name) const
    {
        utsname machine {};
        ::uname (&machine);
        const auto to = folder / "sdk" / "lib/release" / ("lin-" + std::string (machine.machine) + "-gcc");
        std::filesystem::create_directories (to);
        std::filesystem::create_symlink (std::filesystem::path (TACTUS_FAKE_LIBRARIES) / fake, to / name);
    }

    FakeArms::Arm& arm (int index = 0) const { return arms->arms[static_cast<std::size_t> (index)]; }

    static host::PluginDevice::Options patient()
    {
        return { .silence_s = 60.0, .look_again = std::chrono::milliseconds (2), .patience = std::chrono::minutes (1), .real_time = false };
    }

    /// Opens the arm; false, with the messages, if that fails.
    bool opens (Json description = Json::object(), const host::PluginDevice::Options& options = patient())
    {
        description["driver"] = "forcedimension";
        messages.clear();
        device.reset();
        const auto driver = host::DeviceDriver::within (host::forcedimension::driver);
        REQUIRE (driver);
        auto there = (*driver)->open (description, messages);
        if (! there) return false;
        limits = there->about().limits;
        device_watchdog_s = there->about().device_watchdog_s;
        device = std::make_unique<host::PluginDevice> (std::move (there), std::nullopt, options);
        device->prepare (1e-3);
        return true;
    }

    /// The messages about a description that is refused, or about an arm that is open.
    std::string said (const Json& description = Json::object())
    {
        opens (description);
        return text (messages);
    }

    /// One tick with an effort. True if the reading is valid.
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

    bool reads()
    {
        return ticksUntil ([&] { return reading.valid; });
    }

    /// True as soon as the arm feels 1 N along z.
    bool pushes()
    {
        arm().force[2] = 0.0;
        return ticksUntil ([&] { return arm().force[2] == 1.0 && arm().is_enabled != 0; }, along (2));
    }

    static Effort along (int axis, double newtons = 1.0)
    {
        Effort effort;
        effort.force[axis] = newtons;
        return effort;
    }

    /// The force on the tool now, along z.
    double acting() const
    {
        const auto now = std::chrono::duration_cast<std::chrono::nanoseconds> (fromNow (std::chrono::nanoseconds (0)).time_since_epoch()).count();
        return FakeArms::forceAt (arm(), now, 2);
    }

    const std::string home = std::getenv ("HOME") != nullptr ? std::getenv ("HOME") : "";
    TemporaryFolder folder;
    FakeArms* arms = nullptr;
    GuardLimits limits;
    double device_watchdog_s = 0.0;
    Messages messages;
    std::unique_ptr<host::PluginDevice> device;
    Reading reading;
};

}   // namespace tactus::test
