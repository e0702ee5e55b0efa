// SPDX-License-Identifier: MIT
#pragma once

#include "json.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace tactus
{

/// The keys of an object while it is read. Searches a small object from end to end, and a large one by the hash of its keys.
class SeenKeys
{
public:
    /// True if there is a member with this key already. Give it the same object each time; members may only be added to it.
    bool has (const Json::Object& members, std::string_view wanted)
    {
        constexpr std::size_t few = 12;
        if (members.size() <= few) return std::ranges::find (members, wanted, &Json::Member::first) != members.end();
        if (table.size() < 2 * members.size())
        {
            table.assign (std::bit_ceil (4 * members.size()), 0);
            in_table = 0;
        }
        for (; in_table < members.size(); ++in_table)
            table[placeOf (members, members[in_table].first)] = static_cast<std::uint32_t> (in_table + 1);
        return table[placeOf (members, wanted)] != 0;
    }

private:
    std::size_t placeOf (const Json::Object& members, std::string_view wanted) const
    {
        auto i = std::hash<std::string_view> {}(wanted) & (table.size() - 1);
        while (table[i] != 0 && members[table[i] - 1].first != wanted)
            i = (i + 1) & (table.size() - 1);
        return i;
    }

    std::vector<std::uint32_t> table;   // by hash: index of the member + 1; 0: free
    std::size_t in_table = 0;           // how many members are in the table
};

}   // namespace tactus
