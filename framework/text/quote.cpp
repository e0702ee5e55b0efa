// SPDX-License-Identifier: MIT
#include "quote.hpp"

namespace tactus
{
namespace
{
/// Size in bytes of the UTF-8 character at the start of a string; 0 if it is not valid.
std::size_t characterSize (std::string_view text)
{
    const auto byte = [&] (std::size_t i) { return i < text.size() ? static_cast<unsigned char> (text[i]) : 0u; };
    const auto follows = [&] (std::size_t i) { return (byte (i) & 0xC0u) == 0x80u; };

    const unsigned first = byte (0);
    if (first < 0x80u) return 1;
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
}   // namespace

std::string quote (std::string_view text)
{
    constexpr std::size_t longest = 60;
    constexpr char digits[] = "0123456789ABCDEF";

    std::string out = "'";
    while (! text.empty())
    {
        if (out.size() > longest) return out + "…'";
        const auto size = characterSize (text);
        const auto byte = static_cast<unsigned char> (text[0]);
        if (size == 0 || byte < 0x20u || byte == 0x7Fu)
            out.append ("\\x").append (1, digits[byte >> 4u]).append (1, digits[byte & 15u]);
        else
            out += text.substr (0, size);
        text.remove_prefix (size == 0 ? 1 : size);
    }
    return out + "'";
}

}   // namespace tactus
