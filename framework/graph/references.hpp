// SPDX-License-Identifier: MIT
#pragma once

/// What refers to a node by its name: wires, shown ports, overrides, targets of controls; in its own patch, and from
/// outside through the instances of its subgraph.

#include "edit.hpp"

#include <string_view>
#include <vector>

namespace tactus::graph
{

/// Both return the commands that put back what was touched, in the order in which they are to be carried out.
std::vector<Command> renameReferences (Graph&, std::string_view patch, std::string_view node, std::string_view to);
std::vector<Command> dropReferences (Graph&, std::string_view patch, std::string_view node);

}   // namespace tactus::graph
