// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace tactus::host
{

/// The font files embedded by embed.cmake: Inter, or DejaVu Sans if Inter is not installed.
std::span<const unsigned char> regularTypefaceData() noexcept;
std::span<const unsigned char> boldTypefaceData() noexcept;

}   // namespace tactus::host
