// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

#include <tactus/text/result.hpp>

#include <optional>
#include <span>

namespace tactus::host::hid
{

/// The number in an answer. Empty if the answer contains none yet; an error if the device refuses to give one. Accepts any bytes.
Result<std::optional<std::uint32_t>> numberIn (const Answer&, std::span<const std::uint8_t> report);

}   // namespace tactus::host::hid
