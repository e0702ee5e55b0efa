// SPDX-License-Identifier: MIT
#include "names.hpp"

#include <functional>
#include <utility>

namespace tactus::plan
{

namespace
{
std::uint32_t hashOf (std::string_view name) noexcept { return static_cast<std::uint32_t> (std::hash<std::string_view> {}(name)); }
}   // namespace

std::size_t Names::add (std::string_view added)
{
    const auto hash = hashOf (added);
    if (const auto known = table[placeOf (added, hash)].number_and_1; known != 0) return known - 1;
    if (2 * (size() + 1) > table.size()) grow();

    text += added;
    begins.push_back (text.size());
    table[placeOf (added, hash)] = { hash, static_cast<std::uint32_t> (size()) };
    return size() - 1;
}

std::size_t Names::find (std::string_view wanted) const noexcept
{
    const auto known = table[placeOf (wanted, hashOf (wanted))].number_and_1;
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
