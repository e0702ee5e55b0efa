// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tactus::host::hid
{

/// "02 00 ff", spaces wherever one likes between bytes; "00*20" are twenty bytes of 00, twenty counted in decimals.
/// Nothing if it is anything else, or longer than a report may be.
std::optional<Bytes> bytesOf (std::string_view hex);

/// "02 00 ff"
std::string hexOf (std::span<const std::uint8_t>);

}   // namespace tactus::host::hid
