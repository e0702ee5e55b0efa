// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>

namespace tactus::host
{

/// The value of a key; null if there is none, or if this is no object.
inline const Json* member (const Json& from, const char* key)
{
    if (! from.is_object()) return nullptr;
    const auto at = from.find (key);
    return at != from.end() ? &*at : nullptr;
}

}   // namespace tactus::host
