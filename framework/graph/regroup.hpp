// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

namespace tactus::graph
{

/// Both carry out their command, whose patch and nodes must be there and its new names free. They return why it cannot
/// be done, and then leave the graph half done.
std::optional<Message> collapse (Graph&, const CollapseNodes&);
std::optional<Message> expand (Graph&, const ExpandNode&);

}   // namespace tactus::graph
