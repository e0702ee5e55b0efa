// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>

#include <tl/expected.hpp>

#include <optional>
#include <span>

namespace tactus::host::hid
{

/// The number in an answer, whatever its bytes are; nothing if there is none, or none yet; or why there will be none.
tl::expected<std::optional<std::uint32_t>, Message> numberIn (const Answer&, std::span<const std::uint8_t> report);

}   // namespace tactus::host::hid
