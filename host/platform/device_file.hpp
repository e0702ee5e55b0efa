// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host
{

/// True if the system has such a device file and does not let this user read and write it. [any thread]
bool isForbidden (const std::string& path) noexcept;

/// The report descriptor of a HID device file such as /dev/hidraw3, byte for byte; empty where the system does not tell.
/// Nobody needs a permission for it. [any thread]
std::string reportDescriptorOf (const std::string& path);

/// Where the running program is; empty where the system does not tell. [any thread]
std::filesystem::path programFolder();

}   // namespace tactus::host
