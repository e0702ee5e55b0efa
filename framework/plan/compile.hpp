// SPDX-License-Identifier: MIT
#pragma once

/// From graph to plan, in steps that each stand in a file of their own:
///
///   flatten      subgraphs expanded, names resolved, values read      flatten.hpp, directory.hpp, values.hpp
///   unit_check   units of wires and values, generic nodes typed       unit_check.hpp
///   order        running order, loops, delays                         order.hpp
///   sections     what runs less or more often than once a tick        sections.hpp, aliasing.hpp, crossings.hpp
///   build        nodes made, storage laid out, records written        build.hpp
///   lateness     what holds back what returns to the hand             lateness.hpp
///   succession   what goes on from the plan before                    succession.hpp, heirs.hpp, takeover.hpp

#include "flatten.hpp"
#include "plan.hpp"

#include <framework/graph/graph.hpp>
#include <framework/message.hpp>

namespace tactus
{

struct CompileOptions
{
    double rate_hz = 0.0;                       ///< 0: the graph's own
    std::vector<std::string> feeds {};          ///< ports driven from outside: "drag.position.x", "drag.mu"
    std::vector<std::string> records {};        ///< ports to tap; none: the inputs of every sink
    std::vector<plan::Override> overrides {};   ///< values that outrank the file's
    Assets* assets = nullptr;                   ///< where the files that settings name come from
    Services services {};                       ///< what is lent to the nodes
    const Plan* before = nullptr;               ///< the plan that the new one is to take over from, by Plan::takeOver
    const Plan* withdrawn = nullptr;            ///< one that was to take over from that plan too, and will not: parameters of nodes that it had first stay where they were turned
};

struct Compiled
{
    std::shared_ptr<Plan> plan;   ///< null if there are errors, except for placeholders
    Messages messages;
};

/// Pure: the same graph and options give the same plan, whatever the order its nodes and wires were written in.
/// All problems are reported at once. A node of an unknown type is an error of the list, but the plan still runs with a
/// placeholder in its place. The plan before may tick meanwhile. [main thread]
Compiled compile (const graph::Graph&, const Catalogue&, const CompileOptions& = {});

}   // namespace tactus
