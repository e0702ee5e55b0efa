// SPDX-License-Identifier: MIT
#include "driver_ports.hpp"

#include <host/devices/hid/usb_adapter.hpp>

#include <algorithm>
#include <cstddef>

namespace tactus::host::hid
{

namespace
{
constexpr DriverPort known[] { { "0403", "cb48", "falcon", "a Novint Falcon" } };

bool isOf (const DriverPort& device, const SerialPort& port) { return port.vid == device.vid && port.pid == device.pid; }
}   // namespace

const DriverPort* driverOf (const SerialPort& port)
{
    const auto* found = std::ranges::find_if (known, [&] (const auto& device) { return isOf (device, port); });
    return found != std::end (known) ? found : nullptr;
}

const DriverPort* deviceOf (std::string_view driver)
{
    const auto* found = std::ranges::find (known, driver, [] (const auto& device) { return std::string_view (device.driver); });
    return found != std::end (known) ? found : nullptr;
}

std::vector<std::string> portsOf (const DriverPort& device, std::span<const SerialPort> ports, const std::filesystem::path& usb)
{
    std::vector<std::string> all;
    for (const auto& port : ports)
        if (isOf (device, port)) all.push_back (port.path);
    const auto without = all.empty() ? usbEntries (usb, device.vid, device.pid).size() : 0;
    for (std::size_t i = 0; i < without; ++i)
        all.push_back (i == 0 ? "usb" : "usb:" + std::to_string (i));
    return all;
}

std::string withoutPort (std::span<const SerialPort> ports, const std::filesystem::path& usb)
{
    std::string all;
    for (const auto& device : known)
    {
        const auto with_port = static_cast<std::size_t> (std::ranges::count_if (ports, [&] (const auto& port) { return isOf (device, port); }));
        const auto id = std::string (device.vid) + " " + device.pid;
        if (usbEntries (usb, device.vid, device.pid).size() > with_port)
            all += "USB device " + id + "   " + device.what + "\n    the kernel does not know it as a serial port: sudo sh -c 'modprobe ftdi_sio && echo " + id
                   + " > /sys/bus/usb-serial/drivers/ftdi_sio/new_id'\n    or, with libftdi: --device ROLE=" + device.driver + ":usb\n";
    }
    return all;
}

}   // namespace tactus::host::hid
