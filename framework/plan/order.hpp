// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

namespace tactus::plan
{

/// The nodes in an order in which each runs after everything it needs on the same tick; peeking nodes give their
/// outputs before any runs. A loop without a delay is an error (graph/loop), its chain printed with a proposal where
/// to put one. Ties go by path, so the order does not depend on how the file was written.
std::vector<int> order (Flat&);

/// How late a sink answers a source, in ticks, over all paths between them.
struct PathDelay
{
    std::string source, sink;
    int shortest = 0, longest = 0;
    bool recirculates = false;   ///< a loop lies on the way, so that echoes follow after `longest`
};

/// The delays between all device nodes that read and all that act, wherever a path joins them. `node_delays` holds the
/// ticks each node takes from its inputs to its outputs.
std::vector<PathDelay> pathDelays (const Flat&, const std::vector<int>& node_delays);

}   // namespace tactus::plan
