// SPDX-License-Identifier: MIT
#pragma once

#include "directory.hpp"

namespace tactus::plan
{

/// Adds the node that replaces an instance of a bypassed subgraph. It has the exposed ports of the subgraph, and its outputs pass on
/// the inputs of the same name. `around` is the patch of the subgraph node; `inside` is the expanded instance, which learns the
/// number of the new node.
void addBypassNode (const Scope& around, const graph::Node&, Origin, bool muted, Scope& inside, int instance, Flat&);

}   // namespace tactus::plan
