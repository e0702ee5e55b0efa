// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace tactus
{

/// Adds an entry to a list in a sentence: "a, b, c".
inline void addToList (std::string& list, std::string_view entry, std::string_view between = ", ")
{
    if (! list.empty()) list += between;
    list += entry;
}

/// The texts of a range as such a list.
template <typename Texts = std::initializer_list<std::string>>
std::string listText (const Texts& texts, std::string_view between = ", ")
{
    std::string list;
    bool is_first = true;
    for (const auto& text : texts)
    {
        if (! is_first) list += between;
        list += text;
        is_first = false;
    }
    return list;
}

}   // namespace tactus
