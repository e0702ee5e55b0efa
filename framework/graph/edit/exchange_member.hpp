// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/edit.hpp>

#include <optional>
#include <string>

namespace tactus::graph
{

/// The value and the place of a member that was replaced or removed.
struct OldMember
{
    std::optional<Json> value;
    Place place;
};

/// Sets or removes a member of an object. A new member goes to the given place. Returns the old member.
OldMember exchangeMember (Json& object, const std::string& key, const std::optional<Json>& value, Place);

}   // namespace tactus::graph
