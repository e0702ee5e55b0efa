// SPDX-License-Identifier: MIT
#include "exchange_member.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <utility>

namespace tactus::graph
{

OldMember exchangeMember (Json& object, const std::string& key, const std::optional<Json>& value, Place place)
{
    auto& members = object.asObject();
    const auto it = std::ranges::find (members, key, [] (const auto& m) -> const std::string& { return m.first; });
    if (it != members.end() && value) return { std::exchange (it->second, *value), std::nullopt };
    if (it == members.end() && ! value) return {};

    // Keys of an ordered object cannot be moved, so the object is rebuilt.
    const auto index = it != members.end() ? at (it - members.begin()) : std::min (place.value_or (members.size()), members.size());
    OldMember old;
    auto changed = Json::object();
    std::size_t i = 0;
    for (auto& [k, v] : members)
    {
        if (i++ == index)
        {
            if (! value)
            {
                old = { std::move (v), index };
                continue;
            }
            append (changed, key, *value);
        }
        append (changed, k, std::move (v));
    }
    if (value && index == i) append (changed, key, *value);
    object = std::move (changed);
    return old;
}

}   // namespace tactus::graph
