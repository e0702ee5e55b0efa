// SPDX-License-Identifier: MIT
#include "driver_ports.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

namespace tactus::host::hid
{

namespace
{
namespace fs = std::filesystem;

constexpr DriverPort known[] { { "0403", "cb48", "falcon", "a Novint Falcon" } };

bool isOf (const DriverPort& device, const SerialPort& port) { return port.vid == device.vid && port.pid == device.pid; }

std::string firstWord (const fs::path& file)
{
    std::ifstream in (file);
    std::string word;
    in >> word;
    return word;
}
}   // namespace

const DriverPort* driverOf (const SerialPort& port)
{
    const auto* found = std::ranges::find_if (known, [&] (const auto& device) { return isOf (device, port); });
    return found != std::end (known) ? found : nullptr;
}

std::string withoutPort (std::span<const SerialPort> ports, const fs::path& usb)
{
    std::string all;
    for (const auto& device : known)
    {
        auto left = -std::ranges::count_if (ports, [&] (const auto& port) { return isOf (device, port); });
        std::error_code failed;
        for (fs::directory_iterator it (usb, failed), end; ! failed && it != end; it.increment (failed))
            left += firstWord (it->path() / "idVendor") == device.vid && firstWord (it->path() / "idProduct") == device.pid ? 1 : 0;
        const auto id = std::string (device.vid) + " " + device.pid;
        if (left > 0)
            all += "USB device " + id + "   " + device.what + "\n    the kernel does not know it as a serial port: sudo sh -c 'modprobe ftdi_sio && echo " + id
                   + " > /sys/bus/usb-serial/drivers/ftdi_sio/new_id'\n    or, with libftdi: --device ROLE=" + device.driver + ":usb\n";
    }
    return all;
}

}   // namespace tactus::host::hid
