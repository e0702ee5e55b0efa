// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tactus::readers
{

/// Removes a number from the front of the bytes; empty if there are too few bytes.
template <typename T>
std::optional<T> takeNumber (std::string_view& bytes, std::endian order) noexcept
{
    if (bytes.size() < sizeof (T)) return std::nullopt;
    std::array<char, sizeof (T)> raw;
    std::copy_n (bytes.begin(), raw.size(), raw.begin());
    if (order != std::endian::native) std::ranges::reverse (raw);
    bytes.remove_prefix (raw.size());
    return std::bit_cast<T> (raw);
}

}   // namespace tactus::readers
