// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>

#include <string>

namespace tactus::host
{

/// The smallest graph in which a node of a type can be felt or watched. Its inputs are wired to a hand and a wall where these supply
/// the right quantity, and its first force output is wired to a motor.
graph::Graph exampleOf (const NodeType&, const Catalogue&);

}   // namespace tactus::host
