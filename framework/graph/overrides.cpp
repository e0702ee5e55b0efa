// SPDX-License-Identifier: MIT
#include "overrides.hpp"

#include "instances.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>

namespace tactus::graph
{

namespace
{
/// The path of an override as seen from outside its node.
std::string absolute (const std::string& key) { return (key.starts_with ('[') ? "x" : "x/") + key; }

/// True if `by` covers the key, or the parameter whose component or entry the key names.
bool covered (const std::string& key, const std::string& by)
{
    const auto text = absolute (key);
    const auto end = covers (absolute (by), text);
    return end && (*end == text.size() || text[*end] == '.' || text[*end] == '[');
}
}   // namespace

std::vector<const Json::Member*> byPrecedence (const Json& overrides)
{
    std::vector<const Json::Member*> all;
    if (overrides.is_object())
        for (const auto& entry : overrides.asObject())
            all.push_back (&entry);
    std::ranges::stable_sort (all, {}, [] (const auto* entry) { return namedInstances (entry->first); });
    return all;
}

void giveOverride (Json& overrides, const std::string& key, const Json& value)
{
    auto changed = Json::object();
    for (const auto& [k, v] : overrides.items())
        if (! covered (k, key)) append (changed, k, v);
    append (changed, key, value);
    overrides = std::move (changed);
}

Json rolesOf (const Node& node, int instance)
{
    if (! node.roles.is_object()) return node.roles;
    auto roles = Json::object();
    for (const auto& [inner, outer] : node.roles.items())
        append (roles, inner, outer.is_array() ? outer.at (at (instance)) : outer);
    return roles;
}

}   // namespace tactus::graph
