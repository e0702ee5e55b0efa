// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>

#include <string>

namespace tactus::host
{

/// The value of a key; null if there is none, or if this is no object.
inline const Json* member (const Json* from, const char* key)
{
    if (from == nullptr || ! from->is_object()) return nullptr;
    const auto at = from->find (key);
    return at != from->end() ? &*at : nullptr;
}

inline const Json* member (const Json& from, const char* key) { return member (&from, key); }

/// The text of a key; empty if there is none.
inline std::string textAt (const Json& from, const char* key)
{
    const auto* at = member (from, key);
    return at != nullptr && at->is_string() ? at->asString() : std::string();
}

}   // namespace tactus::host
