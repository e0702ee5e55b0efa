// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/catalogue.hpp>
#include <framework/graph/graph.hpp>

#include <string>

namespace tactus::host
{

/// The smallest graph in which a node of a type can be felt or watched: a hand and a wall before it, as far as its inputs
/// take what they give, and a motor after it, where something it gives is a force.
graph::Graph exampleOf (const NodeType&, const Catalogue&);

}   // namespace tactus::host
