// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"
#include <tactus/plan/flat/grouped.hpp>

#include <cstdint>

namespace tactus::plan
{

/// A node or an inner section; the other number is -1.
struct Step
{
    int node = -1, section = -1;
};

/// The steps of each section, in running order.
using Order = std::vector<std::vector<Step>>;

/// Finds an order in which each node runs after everything it needs on the same tick of its section. Peeking nodes deliver
/// their outputs before any node runs, and a section runs as a whole. A loop without a delay is an error (graph/loop) that
/// shows the chain and proposes where to put the delay. Ties are broken by path, so the order does not depend on how the file
/// was written.
Order order (Flat&);

/// Strongly connected components of a graph of `size` nodes with these successors. Each component has a higher number than those
/// it leads to.
std::vector<int> components (std::size_t size, const Grouped<int>& next);

/// The range of delays from a source to a sink over all paths between them, in ticks of the graph. A value that arrives between
/// two runs of an `every` section waits for the next run, which adds nothing to the shortest delay and up to k - 1 ticks to the
/// longest.
struct PathDelay
{
    std::string source, sink;
    std::int64_t shortest = 0, longest = 0;
    bool recirculates = false;   ///< there is a loop on the way, so echoes follow after `longest`
};

/// The delay that a wire adds to a path, in ticks of the graph: its own delay, and the delay of linear outputs of the sections it leaves. The wire
/// must have a start.
std::int64_t delayOf (const Flat&, const PortUnits&, const FlatWire&);

/// The delays between all device sources and all device sinks that a path connects. `node_delays` holds the ticks from the
/// inputs to the outputs of each node, in ticks of its section.
std::vector<PathDelay> pathDelays (const Flat&, const PortUnits&, const std::vector<int>& node_delays);

}   // namespace tactus::plan
