// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>

#include <tactus/text/result.hpp>

#include <string>

namespace tactus::graph
{

/// Finds a wire of a patch ("" for the graph itself) by its text, in any spelling that means the same: with other spaces, "a[*]" for "a",
/// "grain/wave.position" for the port "grain.position" that exposes it. If several wires fit, the one that is spelled like the text, else
/// the first. Errors: wire/syntax, edit/unknown_patch, edit/unknown_wire.
Result<Id> findWire (const Graph&, const std::string& patch, const std::string& text);

}   // namespace tactus::graph
