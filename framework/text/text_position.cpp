// SPDX-License-Identifier: MIT
#include "text_position.hpp"

#include "json.hpp"
#include "json_text.hpp"

#include <charconv>

namespace tactus
{

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
