// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

namespace tactus::graph
{

/// The command that keeps a value for a parameter by the name people use, as a knob that was turned is saved: "drag.mu"
/// and "finger.mu" among the params of their node, "finger/drag.mu" and "finger[3]/drag.mu" among the overrides of the
/// outermost subgraph node, "finger[3].mu" there too, as what it shows. Without a value, the parameter goes back to what
/// it is without. Ids: param/name, edit/unknown_node, param/unknown, and param/shape for a part of what is kept as a whole.
std::variant<Command, Message> paramEdit (const Graph&, std::string_view name, std::optional<Json> value);

}   // namespace tactus::graph
