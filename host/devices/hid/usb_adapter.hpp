// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace tactus::host::hid
{

/// The sentence that tells how to shorten the time for which the adapter of a serial port keeps answers. Empty if that is 1 ms, or if the port has no such
/// timer. [any thread]
inline std::string slowAdapter (const std::filesystem::path& port, const std::filesystem::path& adapters = "/sys/bus/usb-serial/devices")
{
    std::error_code failed;
    const auto timer = adapters / std::filesystem::canonical (port, failed).filename() / "latency_timer";
    std::ifstream in (failed ? std::filesystem::path() : timer);
    std::string ms;
    if (! (in >> ms) || ms == "1") return {};
    return "its adapter keeps answers for up to " + ms + " ms: sudo sh -c 'echo 1 > " + timer.string() + "'";
}

/// The entries of a folder of /sys that belong to a USB device with these numbers, as the system writes them. `up`: from an entry to its USB device.
inline std::vector<std::filesystem::path> usbEntries (const std::filesystem::path& folder, const std::string& vid, const std::string& pid,
                                                      const std::filesystem::path& up = {})
{
    const auto is = [] (const std::string& id, const std::filesystem::path& file) {
        std::string word;
        return std::ifstream (file) >> word && word == id;
    };
    std::vector<std::filesystem::path> all;
    std::error_code failed;
    for (std::filesystem::directory_iterator at (folder, failed), end; ! failed && at != end; at.increment (failed))
        if (const auto device = at->path() / up; is (vid, device / "idVendor") && is (pid, device / "idProduct")) all.push_back (at->path());
    return all;
}

}   // namespace tactus::host::hid
