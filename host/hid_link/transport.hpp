// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/match.hpp>

#include <tl/expected.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// A report that is on its way to a device: with its id, or a 0 where it has none, in front.
struct OutgoingReport
{
    Bytes bytes;
    bool is_feature = false;
};

/// An open device. One thread may read while another one does the rest. The destructor closes it. Failures are told in
/// words, as the system says them.
class Transport
{
public:
    virtual ~Transport() = default;

    /// Waits for an input report and returns its size, which may be 0; 0 as well if none came in time. After a failure the
    /// device is gone. A report that is longer than there is room for is cut.
    virtual tl::expected<std::size_t, std::string> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) = 0;

    /// Nothing, or why it was not written. May take as long as the device likes.
    virtual std::optional<std::string> write (std::span<const std::uint8_t> report) = 0;
    virtual std::optional<std::string> sendFeature (std::span<const std::uint8_t> report) = 0;

    /// Asks for the feature report whose id is the first byte, and leaves it there.
    virtual std::optional<std::string> getFeature (std::span<std::uint8_t> report) = 0;

    /// Has these written, in this order, if the process dies without having closed the device; what was left before is
    /// forgotten. Returns why it cannot be, if so.
    virtual std::optional<std::string> leaveWill (const std::vector<OutgoingReport>&) { return std::nullopt; }
};

/// A device that is connected, open or not.
struct ConnectedDevice : DeviceInfo
{
    std::string path;           ///< as the system names it: /dev/hidraw3
    std::string serial;         ///< empty where it has none
    std::string manufacturer;   ///< likewise
};

/// Why a device did not open.
struct OpenFailure
{
    bool not_permitted = false;
    std::string why;
};

/// What is connected, and the way to it. [any thread]
class HidSystem
{
public:
    virtual ~HidSystem() = default;

    virtual std::vector<ConnectedDevice> connected() = 0;
    virtual tl::expected<std::unique_ptr<Transport>, OpenFailure> open (const ConnectedDevice&) = 0;

    /// What a device says about its own reports, without opening it; empty where the system does not tell.
    virtual Bytes reportDescriptor (const ConnectedDevice&) { return {}; }

    /// Whether open() would be let, without trying.
    virtual bool mayOpen (const ConnectedDevice&) { return true; }
};

/// The devices of this computer, through hidapi.
HidSystem& thisComputer();

}   // namespace tactus::host::hid
