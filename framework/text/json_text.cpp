// SPDX-License-Identifier: MIT
#include "json_text.hpp"

#include <algorithm>

namespace tactus
{

void appendPointerPart (std::string& pointer, std::string_view key)
{
    const auto is_special = [] (char c) { return c == '~' || c == '/'; };
    if (std::ranges::none_of (key, is_special))
    {
        pointer += key;
        return;
    }
    std::size_t done = 0;
    for (std::size_t i = 0; i < key.size(); ++i)
        if (is_special (key[i]))
        {
            pointer.append (key.substr (done, i - done)).append (key[i] == '~' ? "~0" : "~1");
            done = i + 1;
        }
    pointer.append (key.substr (done));
}

std::string pointerPart (std::string_view key)
{
    std::string part;
    appendPointerPart (part, key);
    return part;
}

TextPosition positionOf (const TextPositions& positions, std::string_view pointer)
{
    while (true)
    {
        if (const auto known = positions.find (pointer)) return *known;
        const auto slash = pointer.rfind ('/');
        if (slash == std::string_view::npos) return {};
        pointer = pointer.substr (0, slash);
    }
}

void append (Json& object, std::string key, Json value)
{
    object.asObject().emplace_back (std::move (key), std::move (value));
}

}   // namespace tactus
