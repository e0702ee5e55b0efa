// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

#include <tactus/graph/graph.hpp>

namespace tactus::plan
{

/// Gives a role to each node that learns about a device (NodeType::learn): the role of the nearest device node from which wires lead to
/// the node, or if there is none, of the nearest one to which wires lead from the node. Of several at the same distance, the
/// first by path counts. The role stays empty if no wires lead from or to a device node.
void findDevices (Flat&);

/// The mechanics of the tool of a role's device, according to the graph: `mass` and `damping` in its description. The session may use another device.
DeviceMechanics describedDevice (const graph::Graph&, const std::string& role);

/// Warns (rate/device_delay) if a node compensates a shorter delay than its device has in the graph's description. A node compensates
/// a delay if it learns about its device and has a setting `delay`, in ticks.
void warnOfDeviceDelay (Flat&, const FlatNode&, const graph::Graph&);

}   // namespace tactus::plan
