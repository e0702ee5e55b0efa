// SPDX-License-Identifier: MIT
#pragma once

#include "match.hpp"
#include "report_descriptor.hpp"

#include <tactus/text/result.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace tactus::host::hid
{

/// What a HID device tells the system when it is plugged in.
struct DeviceIdentity
{
    DeviceInfo info;
    Bytes descriptor;   ///< its report descriptor
};

/// A report by its id, and the size of its data in bytes.
struct ReportSize
{
    DescribedField::Kind kind = DescribedField::Kind::input;
    std::optional<std::uint8_t> id;
    std::size_t size = 0;
};

/// The descriptor of a device with one collection, whose reports are bytes without a meaning: all fields have a usage of the vendor, so the system
/// makes neither a keyboard nor a pointer out of them, whatever the collection is. The reports with one id must be of different kinds.
Bytes describeReports (std::uint16_t usage_page, std::uint16_t usage, std::span<const ReportSize>);

/// A device that a profile fits, as its first rule describes it. Id: fake/wire if the profile has no rule or no input report, or if it has reports with and
/// without ids.
Result<DeviceIdentity> identityOf (const Profile&);

/// What a device with the profile answers to a request for a feature report that `init` makes: the id, or a 0 if it has no ids, and zeros. Empty: it has no such report.
Bytes featureOf (const Profile&, std::uint8_t id);

}   // namespace tactus::host::hid
