// SPDX-License-Identifier: MIT
#include "names.hpp"

#include <tactus/text/quick_hash.hpp>

#include <utility>

namespace tactus::plan
{

std::size_t Names::add (std::string_view added)
{
    const auto hash = quickHash (added);
    if (2 * (size() + 1) > table.size()) grow();
    auto& place = table[placeOf (added, hash)];
    if (place.number_and_1 != 0) return place.number_and_1 - 1;

    text += added;
    begins.push_back (text.size());
    place = { hash, static_cast<std::uint32_t> (size()) };
    return size() - 1;
}

std::size_t Names::find (std::string_view wanted) const noexcept
{
    const auto known = table[placeOf (wanted, quickHash (wanted))].number_and_1;
    return known == 0 ? none : known - 1;
}

std::size_t Names::placeOf (std::string_view wanted, std::uint32_t hash) const noexcept
{
    auto i = hash & (table.size() - 1);
    while (table[i].number_and_1 != 0 && (table[i].hash != hash || name (table[i].number_and_1 - 1) != wanted))
        i = (i + 1) & (table.size() - 1);
    return i;
}

void Names::grow()
{
    const auto old = std::exchange (table, std::vector<Entry> (2 * table.size()));
    for (const auto& entry : old)
    {
        if (entry.number_and_1 == 0) continue;
        auto i = entry.hash & (table.size() - 1);
        while (table[i].number_and_1 != 0)
            i = (i + 1) & (table.size() - 1);
        table[i] = entry;
    }
}

}   // namespace tactus::plan
