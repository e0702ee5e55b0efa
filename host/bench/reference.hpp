// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/kit/vec3.hpp>

#include <vector>

namespace tactus::bench
{

/// The preset graphs/padded_bench.json, as it was at build time.
const graph::Graph& reference();

/// The preset graphs/dry_wood.json, likewise.
const graph::Graph& dryWood();

/// The tool position on each tick while the graph's simulated hand strokes. All variants get the same path.
std::vector<Vec3> strokeOver (const graph::Graph&);

}   // namespace tactus::bench
