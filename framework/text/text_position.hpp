// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// A position in text, counted from 1. Columns count characters, not bytes.
struct TextPosition
{
    int line = 1, column = 1;

    bool operator== (const TextPosition&) const = default;
};

/// The position of each key and element of a file. For a long list of numbers or rows, only the first 1000 entries are kept; for the rest,
/// the position of the list is close enough. Adding a position is cheap, because most files have no errors and their positions are never
/// used. Finding one searches all keys of the objects and lists on the way.
class TextPositions
{
public:
    static constexpr std::uint32_t none = ~std::uint32_t {};

    /// Adds the value of a file, a member of an object, or an element of a list. Returns its number, which is needed to add its
    /// children. Returns `none` when there is no more room; `none` can also be passed in.
    std::uint32_t addRoot (TextPosition p) { return add (none, 0, 0, p); }
    std::uint32_t addMember (std::uint32_t object, std::string_view key, TextPosition p)
    {
        const auto begin = keys.size();
        if (object == none || begin + key.size() >= none) return none;
        keys += key;
        return add (object, static_cast<std::uint32_t> (begin), static_cast<std::uint32_t> (key.size()), p);
    }
    std::uint32_t addElement (std::uint32_t list, std::size_t index, TextPosition p)
    {
        return list == none || index >= none ? none : add (list, static_cast<std::uint32_t> (index), none, p);
    }

    /// The position of the value at a JSON pointer.
    std::optional<TextPosition> find (std::string_view pointer) const;
    TextPosition at (std::string_view pointer) const { return find (pointer).value(); }

    /// Calls `change (TextPosition&)` for each position.
    template <typename Change>
    void changeAll (Change change)
    {
        for (auto& entry : entries)
            change (entry.position);
    }

private:
    struct Entry
    {
        std::uint32_t first, last, next;     // the first and the last child, and the next sibling
        std::uint32_t key_begin, key_size;   // in `keys`; an element has an index instead, and a size of `none`
        TextPosition position;
    };

    std::uint32_t add (std::uint32_t around, std::uint32_t key_begin, std::uint32_t key_size, TextPosition position)
    {
        constexpr std::size_t most = 4u << 20u;   // a hostile file may have long lists of empty lists
        if (entries.size() == most) return none;
        const auto number = static_cast<std::uint32_t> (entries.size());
        entries.push_back ({ none, none, none, key_begin, key_size, position });
        if (around == none) return number;
        auto& parent = entries[around];
        (parent.last == none ? parent.first : entries[parent.last].next) = number;
        parent.last = number;
        return number;
    }

    bool isNamed (const Entry&, std::string_view part) const;

    std::vector<Entry> entries;
    std::string keys;   // of all members, one after another
};

}   // namespace tactus
