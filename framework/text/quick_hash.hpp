// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace tactus
{

/// A hash of short text, for tables in memory: FNV-1a (Fowler, Noll, Vo). For names of some letters it takes half as long as std::hash.
constexpr std::uint32_t quickHash (std::string_view text) noexcept
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char> (c)) * 0x100000001b3u;
    return static_cast<std::uint32_t> (hash ^ hash >> 32u);
}

}   // namespace tactus
