// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <string>
#include <vector>

namespace tactus::graph
{

/// The `overrides` of a node in order of precedence, lowest first: the more names of a path select a single
/// instance ("a[3]", not "a" or "a[*]"), the higher it ranks. Among equals, the order of the file is kept. The pointers point into `overrides`.
std::vector<const Json::Member*> byPrecedence (const Json& overrides);

/// Adds an override that takes precedence over all existing ones: removes those that it covers, even if they name a single instance.
/// The key has the form that parseOverride reads.
void giveOverride (Json& overrides, const std::string& key, const Json& value);

/// The role mapping of one instance of a subgraph node.
Json rolesOf (const Node&, int instance);

}   // namespace tactus::graph
