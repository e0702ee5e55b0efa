// SPDX-License-Identifier: MIT
#include "text_position.hpp"

#include "json.hpp"
#include "json_text.hpp"

#include <charconv>

namespace tactus
{

std::uint32_t TextPositions::addRoot (TextPosition p) { return add (none, { none, none, none, 0, 0, p }); }

std::uint32_t TextPositions::addMember (std::uint32_t object, std::string_view key, TextPosition p)
{
    const auto begin = keys.size();
    if (object == none || begin + key.size() >= none) return none;
    keys += key;
    return add (object, { none, none, none, static_cast<std::uint32_t> (begin), static_cast<std::uint32_t> (key.size()), p });
}

std::uint32_t TextPositions::addElement (std::uint32_t list, std::size_t index, TextPosition p)
{
    return list == none || index >= none ? none : add (list, { none, none, none, static_cast<std::uint32_t> (index), none, p });
}

std::uint32_t TextPositions::add (std::uint32_t around, Entry entry)
{
    constexpr std::size_t most = 4u << 20u;   // a hostile file may have long lists of empty lists
    if (entries.size() == most) return none;
    const auto number = static_cast<std::uint32_t> (entries.size());
    entries.push_back (entry);
    if (around == none) return number;
    auto& [first, last, next, begin, size, position] = entries[around];
    if (last == none)
        first = number;
    else
        entries[last].next = number;
    last = number;
    return number;
}

bool TextPositions::isNamed (const Entry& e, std::string_view part) const
{
    if (e.key_size != none) return pointerPart (std::string_view (keys).substr (e.key_begin, e.key_size)) == part;
    std::uint32_t index = 0;
    const auto [end, error] = std::from_chars (part.data(), part.data() + part.size(), index);
    return error == std::errc() && end == part.data() + part.size() && index == e.key_begin;
}

std::optional<TextPosition> TextPositions::find (std::string_view pointer) const
{
    if (entries.empty()) return {};
    std::uint32_t here = 0;
    while (! pointer.empty())
    {
        const auto part = pointer.substr (1, pointer.find ('/', 1) - 1);
        pointer.remove_prefix (1 + part.size());
        auto inside = entries[here].first;
        while (inside != none && ! isNamed (entries[inside], part))
            inside = entries[inside].next;
        if (inside == none) return {};
        here = inside;
    }
    return entries[here].position;
}

}   // namespace tactus
