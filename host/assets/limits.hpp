// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

/// Anything larger is refused before memory is allocated, since the header of a file may claim any size.
namespace tactus::host
{

inline constexpr std::size_t most_bytes = 64u << 20;     ///< per file
inline constexpr std::size_t most_numbers = 32u << 20;   ///< per image or table

}   // namespace tactus::host
