// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/device_plugins/driver_answer.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace tactus::host
{

/// Takes what a driver finds: the port, the name, and the state as TACTUS_DEVICE_IN_USE | ….
using Found = std::function<void (const std::string&, const std::string&, std::uint32_t)>;

/// The functions of a driver. `Device` has
///
///     Wanted                                                                        the type of what a person asks for
///     static std::string parse (const tactus_device_description&, Wanted&);         what is wrong; empty if nothing is
///     static std::unique_ptr<Device> open (const Wanted&, tactus_device_about&, std::string& said);
///                                                                                   null with the reason, or else perhaps with a remark
///     std::int32_t read (std::int32_t timeout_ms, tactus_reading&, tactus_device_stamp&, std::string& why);
///     std::int32_t write (const tactus_effort&, std::string& why);
///     std::int32_t rest (std::string& why);
///     static std::string find (const Found&);                                       optional; empty, or why it cannot look
///
/// with the meaning of tactus_device.h, and a destructor that closes it.
template <typename Device>
struct DriverTable
{
    static int32_t check (const tactus_device_description* given, const tactus_plugin_report* report) noexcept
    {
        return answered (report, [&] {
            typename Device::Wanted wanted;
            const auto wrong = Device::parse (*given, wanted);
            return wrong.empty() ? int32_t { TACTUS_DEVICE_OK } : failed (report, wrong);
        });
    }

    static void* open (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report) noexcept
    {
        Device* opened = nullptr;
        answered (report, [&] {
            typename Device::Wanted wanted;
            auto said = Device::parse (*given, wanted);
            if (said.empty()) opened = Device::open (wanted, *about, said).release();
            if (! said.empty()) report->put (report->context, said.data(), said.size());
            return int32_t { TACTUS_DEVICE_OK };
        });
        return opened;
    }

    static int32_t read (void* device, int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report) noexcept
    {
        return told (report, [&] (std::string& why) { return static_cast<Device*> (device)->read (timeout_ms, *to, *stamp, why); });
    }

    static int32_t write (void* device, const tactus_effort* effort, const tactus_plugin_report* report) noexcept
    {
        return told (report, [&] (std::string& why) { return static_cast<Device*> (device)->write (*effort, why); });
    }

    static int32_t rest (void* device, const tactus_plugin_report* report) noexcept
    {
        return told (report, [&] (std::string& why) { return static_cast<Device*> (device)->rest (why); });
    }

    static void close (void* device) noexcept { delete static_cast<Device*> (device); }

    static int32_t find (const tactus_device_finder* finder, const tactus_plugin_report* report) noexcept
    {
        return answered (report, [&] {
            const auto wrong = Device::find ([finder] (const std::string& port, const std::string& name, std::uint32_t state) {
                const tactus_device_found found { sizeof found, port.c_str(), name.c_str(), state };
                finder->add (finder->context, &found);
            });
            return wrong.empty() ? int32_t { TACTUS_DEVICE_OK } : failed (report, wrong);
        });
    }

private:
    template <typename F>
    static int32_t told (const tactus_plugin_report* report, F&& body) noexcept
    {
        return answered (report, [&] {
            std::string why;
            const int32_t answer = body (why);
            if (! why.empty()) failed (report, why);
            return answer;
        });
    }
};

/// The answer of a call that fails, with its reason.
inline std::int32_t because (std::string& why, std::string reason, std::int32_t answer = TACTUS_DEVICE_GONE)
{
    why = std::move (reason);
    return answer;
}

/// Tells the names of the axes and buttons of a device.
template <std::size_t axis_count, std::size_t button_count>
void nameParts (tactus_device_about& about, const char* const (&axes)[axis_count], const char* const (&buttons)[button_count])
{
    about.axes = axes;
    about.axis_count = axis_count;
    about.buttons = buttons;
    about.button_count = button_count;
}

template <typename Device, std::size_t n>
constexpr tactus_device_driver driverTable (const char* name, const char* about, const char* const (&keys)[n])
{
    using Functions = DriverTable<Device>;
    int32_t (*find) (const tactus_device_finder*, const tactus_plugin_report*) noexcept = nullptr;
    if constexpr (requires { Device::find (Found()); }) find = Functions::find;
    return { sizeof (tactus_device_driver), TACTUS_DEVICE_ABI, name, "1.0.0", about, keys, n, Functions::check, Functions::open, Functions::read,
             Functions::write, Functions::rest, Functions::close, find };
}

}   // namespace tactus::host
