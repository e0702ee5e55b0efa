// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>
#include <framework/list.hpp>

#include <vector>

namespace tactus::bench
{

/// The preset graphs/padded_bench.json, as it was when this program was built.
const graph::Graph& reference();

/// Where the tool is on each tick while the preset's simulated hand strokes: the same way for all who are compared.
std::vector<Vec3> strokeOver (const graph::Graph&);

}   // namespace tactus::bench
