// SPDX-License-Identifier: MIT
#pragma once

/// Parts of a graph in the form that they have in a file. Edits use these functions, because an edit must not create anything
/// that a file cannot hold. Copying between graphs uses them, too.

#include "graph.hpp"

#include <tactus/text/result.hpp>

#include <string>

namespace tactus
{

Json toJson (const graph::Node&);   ///< without its name, which is its key
Json toJson (const graph::Wire&);
Json toJson (const graph::Control&);
Json toJson (const graph::Expose&);
Json toJson (const graph::Patch&);

namespace graph
{
/// The errors that the reader of a file would report for a part, in order.
Messages check (const Node&);
Messages check (const Wire&);
Messages check (const Control&);
Messages check (const Expose&);
Messages check (const Patch&);
}   // namespace graph

/// The same for one key of a node: "role", "count", "ui", …
Messages checkNodeKey (const std::string& key, const Json& value);

/// Checks that a file can hold a value. Error: edit/bad_value, for a number that is not finite, a duplicate key
/// or nesting that is too deep.
Result<> checkValue (const Json& value);

}   // namespace tactus
