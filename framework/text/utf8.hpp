// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace tactus
{

/// True for a byte that is not the first of a UTF-8 character.
constexpr bool continuesCharacter (char c) noexcept
{
    return (static_cast<unsigned char> (c) & 0xC0u) == 0x80u;
}

/// Size in bytes of the UTF-8 character at the start of a text, as RFC 3629 allows it: the shortest form, no surrogates, up to U+10FFFF.
/// 0 if there is none.
constexpr std::size_t characterSize (std::string_view text) noexcept
{
    const auto byte = [&] (std::size_t i) { return i < text.size() ? static_cast<unsigned char> (text[i]) : 0u; };
    const auto follows = [&] (std::size_t i) { return (byte (i) & 0xC0u) == 0x80u; };

    const unsigned first = byte (0);
    if (first < 0x80u) return text.empty() ? 0 : 1;
    if (first >= 0xC2u && first < 0xE0u) return follows (1) ? 2 : 0;
    if (first >= 0xE0u && first < 0xF0u)
    {
        const bool overlong = first == 0xE0u && byte (1) < 0xA0u;
        const bool surrogate = first == 0xEDu && byte (1) >= 0xA0u;
        return follows (1) && follows (2) && ! overlong && ! surrogate ? 3 : 0;
    }
    if (first >= 0xF0u && first < 0xF5u)
    {
        const bool outside = (first == 0xF0u && byte (1) < 0x90u) || (first == 0xF4u && byte (1) >= 0x90u);
        return follows (1) && follows (2) && follows (3) && ! outside ? 4 : 0;
    }
    return 0;
}

}   // namespace tactus
