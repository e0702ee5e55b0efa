// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <string>
#include <vector>

namespace tactus::graph
{

/// The `overrides` of a node, those that outrank others last: what names more single instances holds, wherever it stands.
/// They point into it.
std::vector<const Json::object_t::value_type*> byPrecedence (const Json& overrides);

/// Gives the `overrides` of a node a value that outranks all that are there: what it covers goes, also where that named a
/// single instance. The key is as of parseOverride.
void giveOverride (Json& overrides, const std::string& key, const Json& value);

/// The roles that a subgraph node gives to one of its instances.
Json rolesOf (const Node&, int instance);

}   // namespace tactus::graph
