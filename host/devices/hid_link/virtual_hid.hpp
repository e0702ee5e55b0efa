// SPDX-License-Identifier: MIT
#pragma once

#include <host/base/platform/report_file.hpp>
#include <host/devices/hid/device_identity.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace tactus::host::hid
{

/// A HID device that this program simulates and the kernel shows to other programs (Linux: Documentation/hid/uhid.rst). It is plugged in for as long as the
/// object exists. Needs the right to /dev/uhid, which usually only root has. Works only on Linux. [one thread]
class VirtualHid
{
public:
    using Clock = ReportFile::Clock;
    using Outcome = ReportFile::Outcome;

    /// Plugs it in. The serial number tells it from other devices. Ids: fake/uhid if the kernel cannot make it, hid/not_permitted.
    static Result<std::unique_ptr<VirtualHid>> plug (const DeviceIdentity&, const std::string& serial);

    ~VirtualHid();
    VirtualHid (const VirtualHid&) = delete;
    VirtualHid& operator= (const VirtualHid&) = delete;

    /// The answer to a request for the input or feature report with this id. It begins with the id, or with a 0 if the device has none. Empty: the request is
    /// refused.
    std::function<Bytes (std::uint8_t id, bool is_feature)> on_ask;

    /// Takes the next output or feature report that a program has sent, or waits for one; does not wait if `until` has passed. Answers the requests that come
    /// meanwhile. A report without an id begins with a 0 on some kernels.
    Outcome read (std::span<std::uint8_t> into, Clock::time_point until);

    /// Sends an input report. False if the kernel does not take it.
    bool send (std::span<const std::uint8_t> report);

    /// True while a program has the device open. Up to date after read().
    bool isOpen() const noexcept { return is_open; }

    /// The file of the device, such as /dev/hidraw3; empty until the kernel has made it, which may need answers to requests.
    std::string path() const;

private:
    VirtualHid (int f, std::string s) : file (f), serial (std::move (s)) {}

    int file = -1;
    const std::string serial;
    bool is_open = false;
};

}   // namespace tactus::host::hid
