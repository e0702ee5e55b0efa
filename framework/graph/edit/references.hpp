// SPDX-License-Identifier: MIT
#pragma once

/// References to a node by name: in wires, exposed ports, overrides and targets of controls; in its own patch, and from outside
/// through the instances of its subgraph.

#include <tactus/graph/edit.hpp>

#include <string_view>
#include <vector>

namespace tactus::graph
{

/// Both functions return the commands that undo their changes, in the order in which to carry them out.
std::vector<Command> renameReferences (Graph&, std::string_view patch, std::string_view node, std::string_view to);
std::vector<Command> dropReferences (Graph&, std::string_view patch, std::string_view node);

}   // namespace tactus::graph
