// SPDX-License-Identifier: MIT
#include "quote.hpp"

#include "utf8.hpp"

#include <algorithm>

namespace tactus
{
namespace
{
/// The code point of a valid UTF-8 character.
unsigned codePoint (std::string_view character)
{
    const auto byte = [&] (std::size_t i) { return static_cast<unsigned char> (character[i]); };
    if (character.size() == 1) return byte (0);
    unsigned code = byte (0) & (0x7Fu >> character.size());
    for (std::size_t i = 1; i < character.size(); ++i)
        code = code << 6u | (byte (i) & 0x3Fu);
    return code;
}

/// False for control characters (C0, C1), and for characters that are invisible or change the text direction.
bool isHarmless (unsigned code)
{
    const auto within = [code] (unsigned first, unsigned last) { return code >= first && code <= last; };
    return ! within (0, 0x1F) && ! within (0x7F, 0x9F) && code != 0xAD && code != 0x61C && ! within (0x200B, 0x200F) && ! within (0x2028, 0x202E)
           && ! within (0x2060, 0x206F) && code != 0xFEFF && ! within (0xFFF9, 0xFFFB) && ! within (0xE0000, 0xE0FFF);
}

/// Takes the first character of a text, or its first byte if it is not valid UTF-8, and returns it, escaped if it is not harmless.
std::string takeCharacter (std::string_view& text)
{
    constexpr char digits[] = "0123456789ABCDEF";
    const auto size = characterSize (text);
    const auto character = text.substr (0, std::max (size, std::size_t { 1 }));
    text.remove_prefix (character.size());
    if (size > 0 && isHarmless (codePoint (character))) return std::string (character);
    std::string out;
    for (const char c : character)
    {
        const auto byte = static_cast<unsigned char> (c);
        out.append ("\\x").append (1, digits[byte >> 4u]).append (1, digits[byte & 15u]);
    }
    return out;
}
}   // namespace

std::string quote (std::string_view text)
{
    constexpr std::size_t longest = 60;
    std::string out = "'";
    while (! text.empty())
    {
        if (out.size() > longest) return out + "…'";
        out += takeCharacter (text);
    }
    return out + "'";
}

std::string quotePath (const std::filesystem::path& path)
{
    const auto text = path.string();
    std::string out = "'";
    for (std::string_view rest = text; ! rest.empty();)
        out += takeCharacter (rest);
    return out + "'";
}

std::string printable (std::string_view text)
{
    std::string out;
    while (! text.empty())
        if (text.front() == '\n')
        {
            out += '\n';
            text.remove_prefix (1);
        }
        else
            out += takeCharacter (text);
    return out;
}

std::string printableName (std::string_view text)
{
    constexpr std::size_t longest = 200;   // characters; an escape counts as it is shown
    std::string out;
    for (std::size_t shown = 0; ! text.empty();)
    {
        const auto size = characterSize (text);
        const auto character = takeCharacter (text);
        shown += character.size() == size ? 1 : character.size();
        if (shown > longest) return out + "…";
        out += character;
    }
    return out;
}

}   // namespace tactus
