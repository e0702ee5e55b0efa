// SPDX-License-Identifier: MIT
#pragma once

#include "edit.hpp"

namespace tactus::graph
{

/// Both carry out their command. Its patch and nodes must exist, and its new names must be free. On an error (edit/cannot_expand)
/// they leave the graph partly changed.
Result<> collapse (Graph&, const CollapseNodes&);
Result<> expand (Graph&, const ExpandNode&);

}   // namespace tactus::graph
