// SPDX-License-Identifier: MIT
#pragma once

/// Parts of a graph as they stand in a file: for edits, which must not make what a file could not hold, and for copying
/// between graphs.

#include <framework/graph/graph.hpp>
#include <framework/message.hpp>

#include <optional>
#include <string>

namespace tactus
{

Json toJson (const graph::Node&);   ///< without its name, which is its key
Json toJson (const graph::Wire&);
Json toJson (const graph::Control&);
Json toJson (const graph::Expose&);
Json toJson (const graph::Patch&);

/// What the reader of a file would say about a part: errors only, the first ones first.
Messages check (const graph::Node&);
Messages check (const graph::Wire&);
Messages check (const graph::Control&);
Messages check (const graph::Expose&);
Messages check (const graph::Patch&);

/// What it would say about one key of a node: "role", "count", "ui", …
Messages checkNodeKey (const std::string& key, const Json& value);

/// Why a value cannot stand in a file: not a finite number, a key twice, nested too deep.
std::optional<std::string> problemOf (const Json& value);

}   // namespace tactus
