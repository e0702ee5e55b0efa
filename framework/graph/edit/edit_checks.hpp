// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>

#include <tactus/text/message.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>

namespace tactus::graph
{

// What an edit from outside is checked for, besides what graph_parts.hpp checks. `in` is the name of the patch, for the message.

/// An error if the first node of a path does not exist in the patch.
std::optional<Message> problemWith (std::string_view path, const Patch&, const std::string& in);

/// The first error of a wire: one that a file would have too, or an end that does not exist in the patch.
std::optional<Message> problemWith (const Wire&, const Patch&, const std::string& in);

/// The first error of a control: one that a file would have too, or a target whose node does not exist.
std::optional<Message> problemWith (const Control&, const Graph&);

/// True if a control has two targets with the same path, or a node two overrides with the same key.
bool anythingTwice (const Graph&);

/// True if a node or wire has this id. For a single id, this takes a fraction of the time of usedIds().
bool isUsed (Id, const Graph&);

/// The ids of all nodes and wires.
std::unordered_set<Id> usedIds (const Graph&);

/// Lists the nodes that use a subgraph, except nodes inside the subgraph itself.
std::string usersOf (const Graph&, const std::string& subgraph);

}   // namespace tactus::graph
