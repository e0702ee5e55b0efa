// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/edit.hpp>

namespace tactus::graph
{

/// Carries out ExpandNode for a node with a `count`, which must exist: replaces it by one node per instance. On an error
/// (edit/cannot_expand) it leaves the graph partly changed.
Result<> separate (Graph&, const ExpandNode&);

/// The error for a node that cannot be expanded: "'hand' cannot be expanded: it is bypassed".
Message cannotExpand (const std::string& node, const std::string& why);

}   // namespace tactus::graph
