// SPDX-License-Identifier: MIT
#pragma once

#include "grouped.hpp"
#include "unit_check.hpp"

#include <cstdint>

namespace tactus::plan
{

/// A node, or a section within; the other is -1.
struct Step
{
    int node = -1, section = -1;
};

/// By section, what runs in it, the first first.
using Order = std::vector<std::vector<Step>>;

/// An order in which each node runs after everything it needs on the same tick of its section; peeking nodes give their
/// outputs before any runs, and a section runs as a whole. A loop without a delay is an error (graph/loop), its chain
/// printed with a proposal where to put one. Ties go by path, so the order does not depend on how the file was written.
Order order (Flat&);

/// Strongly connected components of a graph of so many nodes given by successors, numbered so that each comes after those it leads to.
std::vector<int> components (std::size_t size, const Grouped<int>& next);

/// How late a sink answers a source, in ticks of the graph, over all paths between them. What comes in between two runs
/// of an `every` section waits for the next, so it adds nothing to the shortest and up to k - 1 ticks to the longest.
struct PathDelay
{
    std::string source, sink;
    std::int64_t shortest = 0, longest = 0;
    bool recirculates = false;   ///< a loop lies on the way, so that echoes follow after `longest`
};

/// What a wire that starts somewhere adds to a path, in ticks of the graph: its delay, and the straight lines in which
/// what it carries leaves sections.
std::int64_t delayOf (const Flat&, const PortUnits&, const FlatWire&);

/// The delays between all device nodes that read and all that act, wherever a path joins them. `node_delays` holds the
/// ticks each node takes from its inputs to its outputs, in those of its section.
std::vector<PathDelay> pathDelays (const Flat&, const PortUnits&, const std::vector<int>& node_delays);

}   // namespace tactus::plan
