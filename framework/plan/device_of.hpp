// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

#include <tactus/graph/graph.hpp>

namespace tactus::plan
{

/// Gives each node that learns of a device (NodeType::learn) a role: that of the nearest device node from which wires lead to the
/// node, else of the nearest one to which wires lead from the node. Of several at the same distance, the first by path. The
/// role stays empty if there is none.
void findDevices (Flat&);

/// What the graph says of the tool of a role's device: `mass` and `damping` in its description. The session may bind another device.
DeviceLayout describedDevice (const graph::Graph&, const std::string& role);

}   // namespace tactus::plan
