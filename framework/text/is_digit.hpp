// SPDX-License-Identifier: MIT
#pragma once

namespace tactus
{

/// True for 0 to 9, whatever the locale.
constexpr bool isDigit (char c) noexcept { return c >= '0' && c <= '9'; }

}   // namespace tactus
