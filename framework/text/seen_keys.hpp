// SPDX-License-Identifier: MIT
#pragma once

#include "json.hpp"
#include "quick_hash.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace tactus
{

/// The keys of an object while it is read. Searches a small object from end to end, and a large one by the hash of its keys.
class SeenKeys
{
public:
    /// Notes a key that is about to be added at the end of the object. False if there is a member with this key already. Give it the same
    /// object each time, and add a member after each call.
    bool add (const Json::Object& members, std::string_view key)
    {
        constexpr std::size_t few = 12;
        if (members.size() <= few) return std::ranges::find (members, key, &Json::Member::first) == members.end();
        if (table.size() < 2 * (members.size() + 1)) grow (members);
        const auto hash = quickHash (key);
        auto i = firstPlaceOf (hash);
        for (; table[i].member_and_1 != 0; i = after (i))
            if (table[i].hash == hash && members[table[i].member_and_1 - 1].first == key) return false;
        table[i] = { hash, static_cast<std::uint32_t> (members.size() + 1) };
        return true;
    }

private:
    struct Entry
    {
        std::uint32_t hash = 0;
        std::uint32_t member_and_1 = 0;   // index of the member + 1; 0: free
    };

    std::size_t firstPlaceOf (std::uint32_t hash) const noexcept { return hash & (table.size() - 1); }
    std::size_t after (std::size_t place) const noexcept { return (place + 1) & (table.size() - 1); }

    /// Makes room for three times as many members. A duplicate key is reported elsewhere, so either of its entries will do.
    void grow (const Json::Object& members)
    {
        const auto old = std::exchange (table, std::vector<Entry> (std::bit_ceil (4 * members.size())));
        if (old.empty())
            for (std::uint32_t m = 0; m < members.size(); ++m)
                keep ({ quickHash (members[m].first), m + 1 });
        else
            for (const auto& entry : old)
                if (entry.member_and_1 != 0) keep (entry);
    }

    void keep (Entry entry) noexcept
    {
        auto i = firstPlaceOf (entry.hash);
        while (table[i].member_and_1 != 0)
            i = after (i);
        table[i] = entry;
    }

    std::vector<Entry> table;   // by hash; its size is a power of two, and at most half of it is in use
};

}   // namespace tactus
