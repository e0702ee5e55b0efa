// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

namespace tactus::graph
{

/// The command that stores a value for a parameter by name, for example to save a knob. "drag.mu" and "finger.mu" go to the
/// params of their node. "finger/drag.mu", "finger[3]/drag.mu" and the exposed "finger[3].mu" go to the overrides of the outermost
/// subgraph node. Without a value, the command removes the stored value.
/// Errors: param/name, edit/unknown_node, param/unknown, and param/shape for a part of a value that is stored as a whole.
Result<Command> paramEdit (const Graph&, std::string_view name, std::optional<Json> value);

}   // namespace tactus::graph
