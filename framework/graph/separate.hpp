// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

namespace tactus::graph
{

/// Carries out ExpandNode for a node with a `count`, which must be there: a node for each instance takes its place. Returns
/// why it cannot be done, and then leaves the graph half done.
std::optional<Message> separate (Graph&, const ExpandNode&);

/// "'hand' is bypassed": why a node cannot be expanded, with or without a `count`.
Message cannotExpand (const std::string& node, const std::string& why);

}   // namespace tactus::graph
