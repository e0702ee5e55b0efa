// SPDX-License-Identifier: MIT
#include "serial_ports.hpp"
#include "wires.hpp"

#include <host/base/platform/device_file.hpp>
#include <host/base/platform/wire_file.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace tactus::host::hid
{
namespace
{
namespace fs = std::filesystem;

constexpr int most_folders = 6;   // from a port up to its USB device

std::string firstLine (const fs::path& file)
{
    std::ifstream in (file);
    std::string line;
    std::getline (in, line);
    return line;
}

/// True for a port with hardware: an interface without any, such as ttyS1 of most computers, has the type 0.
bool isReal (const fs::path& entry)
{
    std::error_code failed;
    return fs::exists (entry / "device", failed) && firstLine (entry / "type") != "0";
}
}   // namespace

std::vector<SerialPort> serialPorts (const fs::path& system, const fs::path& files)
{
    std::vector<SerialPort> all;
    if (auto names = system == "/sys/class/tty" ? WireFile::portNames() : std::vector<std::string>(); ! names.empty())
    {
        for (auto& name : names)
            all.push_back ({ .path = std::move (name) });
        return all;
    }
    std::error_code failed;
    for (fs::directory_iterator it (system, failed), end; ! failed && it != end; it.increment (failed))
    {
        const auto file = files / it->path().filename();
        std::error_code unseen;
        if (! isReal (it->path()) || ! fs::exists (file, unseen)) continue;
        SerialPort port { .path = lastingNameOf (file.string(), (files / "serial/by-id").string()) };
        port.may_open = ! isForbidden (file.string());
        auto folder = fs::canonical (it->path() / "device", unseen);
        for (int up = 0; ! unseen && up < most_folders && port.vid.empty(); ++up, folder = folder.parent_path())
            if (fs::exists (folder / "idVendor", unseen))
            {
                port.vid = firstLine (folder / "idVendor");
                port.pid = firstLine (folder / "idProduct");
                port.product = firstLine (folder / "product");
            }
        all.push_back (std::move (port));
    }
    std::ranges::sort (all, {}, &SerialPort::path);
    return all;
}

bool isOf (const SerialPort& port, const Profile& profile)
{
    const auto is = [] (const std::vector<std::uint16_t>& ids, const std::string& hex) {
        return ! hex.empty() && std::ranges::count (ids, std::strtoul (hex.c_str(), nullptr, 16)) > 0;
    };
    return std::ranges::any_of (profile.match, [&] (const auto& m) { return is (m.vid, port.vid) && is (m.pid, port.pid); });
}

std::vector<std::shared_ptr<const Profile>> profilesFor (const SerialPort& port, std::span<const std::shared_ptr<const Profile>> profiles)
{
    std::vector<std::shared_ptr<const Profile>> all;
    std::ranges::copy_if (profiles, std::back_inserter (all), [] (const auto& p) { return p->wires.serial.has_value(); });
    std::stable_partition (all.begin(), all.end(), [&] (const auto& p) { return isOf (port, *p); });
    return all;
}

}   // namespace tactus::host::hid
