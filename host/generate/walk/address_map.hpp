// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>

namespace tactus::host
{

inline const std::byte* bytes (const void* p) { return static_cast<const std::byte*> (p); }

/// In a map of ranges, ordered by their beginnings: the last range that begins at or before this address.
template <typename Map>
auto lastBefore (const Map& map, const void* address)
{
    const auto next = map.upper_bound (bytes (address));
    return next == map.begin() ? map.end() : std::prev (next);
}

}   // namespace tactus::host
