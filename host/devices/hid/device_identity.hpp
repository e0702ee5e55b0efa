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

/// The identity of a HID device, as it tells the system when it is plugged in.
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

/// A descriptor with one collection, whose reports are bytes without a meaning. All fields are vendor-defined, so the system makes neither a keyboard nor a
/// pointer out of them, whatever the collection is. Two reports with the same id must be of different kinds.
Bytes describeReports (std::uint16_t usage_page, std::uint16_t usage, std::span<const ReportSize>);

/// A device that a profile fits, as its first rule describes it. Id: fake/wire if the profile has no rule or no input report, or if it has reports with and
/// without ids.
Result<DeviceIdentity> identityOf (const Profile&);

/// The answer of a device with this profile to a request for a feature report: the id, or a 0 if the device has no ids, and then zeros. Empty if `init` does
/// not request this report.
Bytes featureOf (const Profile&, std::uint8_t id);

}   // namespace tactus::host::hid
