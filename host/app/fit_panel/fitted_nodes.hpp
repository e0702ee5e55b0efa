// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/tools/fitting/fitting.hpp>
#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>

#include <set>

namespace tactus::host
{

/// Adds the fitted nodes to a patch, with their wires: those of the fit to its hand and its motor, if the patch has one, and what else goes without
/// saying. They have no positions. `made` receives the ids of the fitted nodes, not those of nodes that come with a wire.
Result<graph::Command> addFitted (const graph::Graph&, const std::string& patch, const FittedGraph&, const Catalogue&, std::set<graph::Id>& made);

}   // namespace tactus::host
