// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

#include <string>
#include <unordered_map>

namespace tactus::plan
{

/// Maps the roles inside a subgraph to roles of the whole graph. A role that is not in the map means itself.
using Roles = std::unordered_map<std::string, std::string>;

/// Stores the role of a node, as the whole graph calls it. Reports a device node without a role (node/no_role), and a role of a
/// node that is not a device (warning node/needless_role).
void readRole (const graph::Node&, Origin, const Roles&, FlatNode&, Flat&);

/// Checks the `roles` of a subgraph node with this path. `inside` is its subgraph, `count` the number of its instances. Messages:
/// node/bad_roles, and the warning node/unknown_role.
void checkRoles (const graph::Node&, const std::string& path, Origin, const graph::Patch& inside, int count, Flat&);

/// The roles inside an instance of a subgraph node; `around` maps those in the patch of the node. Leaves out wrong roles, which
/// checkRoles has reported.
Roles rolesInside (const graph::Node&, const Roles& around, int instance);

}   // namespace tactus::plan
