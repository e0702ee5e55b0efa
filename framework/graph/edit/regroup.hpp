// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/edit.hpp>

namespace tactus::graph
{

/// Each function carries out its command. The patch and the nodes that the command names must exist, and its new names must be
/// free. After an error (edit/cannot_expand) the graph is partly changed.
Result<> collapse (Graph&, const CollapseNodes&);
Result<> expand (Graph&, const ExpandNode&);

}   // namespace tactus::graph
