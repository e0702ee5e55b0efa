// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace tactus::host
{

/// True if the device file exists, but the system does not let this user read and write it. [any thread]
bool isForbidden (const std::string& path) noexcept;

/// The report descriptor of a HID device file such as /dev/hidraw3, byte for byte; empty if the system does not provide
/// it. Reading it needs no permission. [any thread]
std::string reportDescriptorOf (const std::string& path);

/// True if each read from this file takes one whole report, as from /dev/hidraw3. [any thread]
bool isReportFile (const std::string& path) noexcept;

}   // namespace tactus::host
