// SPDX-License-Identifier: MIT
#include "offered_devices.hpp"
#include "numbers_device.hpp"
#include "role_fits.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid_link/driver_ports.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>

#include <filesystem>

namespace tactus::host
{

std::vector<OfferedDevice> devicesAt (std::span<const hid::SerialPort> ports, const hid::LoadedProfiles& all)
{
    std::vector<OfferedDevice> offered;
    for (const auto& port : ports)
    {
        if (const auto* known = hid::driverOf (port))
        {
            offered.push_back ({ known->what, { { "driver", known->driver }, { "port", port.path } }, true, port.may_open });
            continue;
        }
        for (const auto& profile : hid::profilesFor (port, all.profiles))
        {
            const bool is_sure = hid::isOf (port, *profile);
            offered.push_back ({ profile->name, { { "driver", "serial" }, { "profile", profile->id }, { "port", port.path } }, is_sure, port.may_open });
            if (is_sure) break;
        }
    }
    return offered;
}

std::vector<OfferedDevice> offeredDevices (const hid::LoadedProfiles& all) { return devicesAt (hid::serialPorts(), all); }

std::vector<OfferedDevice> foundDevices (Messages& messages)
{
    std::vector<OfferedDevice> offered;
    for (auto& device : findDevices (messages))
        offered.push_back ({ device.name + (device.is_in_use ? ", in use" : device.is_seen ? ""
                                                                                           : ", perhaps not connected"),
                             std::move (device.description) });
    return offered;
}

namespace
{
/// The fault of an address that names no device.
std::string wrongIn (std::string_view address, const Message& parsed)
{
    const auto name = address.substr (0, address.find (':'));
    if (name == "hid" || name == "serial" || name == "udp") return parsed.text;
    return graph::isId (name) ? "there is no driver " + quote (name) + " in a plugin" : quote (address) + " is not the address of a device";
}
}   // namespace

Result<Json> readAddress (std::string_view address, const hid::LoadedProfiles& all)
{
    const auto refuse = [] (std::string what) {
        std::string drivers;
        for (const auto& name : installedDrivers())
            addToList (drivers, name);
        return Message::error ("device/address", "", std::move (what),
                               "write serial:PROFILE@PORT, udp:PROFILE@ADDRESS:PORT or hid:PROFILE"
                                   + (drivers.empty() ? std::string() : ", or DRIVER:PORT for a driver in a plugin: " + drivers));
    };
    if (address.find ('=') != address.npos || address.ends_with (".json")) return refuse (quote (address) + " is not the address of a device");
    Messages of_numbers;
    auto parsed = parseDeviceOption (
        "device=" + std::string (address), {}, {}, [&]() -> const hid::LoadedProfiles& { return all; }, of_numbers);
    if (! parsed) return refuse (wrongIn (address, parsed.error()));
    auto& description = parsed->description;
    if (! hid::isHid (description) && ! namesPlugin (description)) return refuse (quote (address) + " is not the address of a real device");
    if (description["driver"] == Json ("serial"))
    {
        const auto port = description["port"].asString();
        if (! std::filesystem::path (port).is_absolute() && ! port.starts_with ("COM"))
            return Message::error ("device/address", "", quote (port) + " is not the path of a serial port", "write the whole path, such as /dev/ttyACM0");
    }
    return std::move (description);
}

}   // namespace tactus::host
