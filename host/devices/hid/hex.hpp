// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tactus::host::hid
{

/// Parses "02 00 ff", with any spaces between bytes; "00*20" means twenty (decimal) bytes of 00. Empty for any other text,
/// or if there are more bytes than a report may have.
std::optional<Bytes> bytesOf (std::string_view hex);

/// "02 00 ff"
std::string hexOf (std::span<const std::uint8_t>);

}   // namespace tactus::host::hid
