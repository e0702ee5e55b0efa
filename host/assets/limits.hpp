// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

/// What is more than this is refused before memory is asked for: a file may claim anything.
namespace tactus::host
{

inline constexpr std::size_t most_bytes = 64u << 20;     ///< of a file
inline constexpr std::size_t most_numbers = 32u << 20;   ///< of a picture or a table

}   // namespace tactus::host
