// SPDX-License-Identifier: GPL-3.0-or-later
#include "found_devices.hpp"

#include <host/cli/report.hpp>
#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid_link/driver_ports.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>

#include <iostream>

namespace tactus::host
{

namespace
{
/// The devices that the driver finds, or else those that are known from serial ports and USB.
std::vector<FoundByDriver> find (const std::string& driver)
{
    auto found = findDevices (driver);
    const auto* device = hid::deviceOf (driver);
    if (found || device == nullptr) return orFail (std::move (found));
    std::vector<FoundByDriver> all;
    for (const auto& port : hid::portsOf (*device, hid::serialPorts()))
        all.push_back ({ .name = device->what, .description = { { "driver", driver }, { "port", port } } });
    return all;
}
}   // namespace

bool listFoundDevices (const std::string& driver, bool as_json)
{
    if (! findDriver (driver)) return false;
    const auto found = find (driver);
    auto json = Json::array();
    for (const auto& device : found)
    {
        const auto port = device.description.value ("port", std::string());
        json.push_back ({ { "driver", driver }, { "port", port }, { "name", device.name }, { "in_use", device.is_in_use }, { "seen", device.is_seen } });
        if (as_json) continue;
        std::cout << printableName (device.name) << (device.is_in_use ? ", in use by another role or program" : "")
                  << (device.is_seen ? "" : "; it was not opened, so whether it is connected is not known") << "\n    --device ROLE=" << driver
                  << (port.empty() ? "" : ":") << printableName (port) << '\n';
    }
    if (as_json)
        std::cout << json.dump (2) << '\n';
    else if (found.empty())
        std::cout << "The driver " << driver << " finds no device.\n";
    return true;
}

std::string driversText()
{
    std::string names;
    for (const auto& name : installedDrivers())
        addToList (names, name);
    return names.empty() ? names : "drivers in plugins: " + names + "; `tactus devices --device DRIVER` loads one and lists what it finds, if it can look\n";
}

}   // namespace tactus::host
