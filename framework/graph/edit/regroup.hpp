// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/edit.hpp>

namespace tactus::graph
{

/// Each function carries out its command. The patch and the nodes that the command names must exist, and its new names must be
/// free. After an error (edit/cannot_expand) the graph is partly changed.
Result<> collapse (Graph&, const CollapseNodes&);
Result<> expand (Graph&, const ExpandNode&);

/// Part of expand(), for a node with a `count`: replaces it by one node per instance.
Result<> separate (Graph&, const ExpandNode&);

/// The error for a node that cannot be expanded: "'hand' cannot be expanded: it is bypassed".
Message cannotExpand (const std::string& node, const std::string& why);

}   // namespace tactus::graph
