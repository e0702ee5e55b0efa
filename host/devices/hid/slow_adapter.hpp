// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

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

}   // namespace tactus::host::hid
