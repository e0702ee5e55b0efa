// SPDX-License-Identifier: MIT
#pragma once

/// From graph to plan, in steps. Each has a folder:
///
///   flat/       expands subgraphs, resolves names, reads values              flatten.hpp, directory.hpp, sections.hpp, values.hpp
///   settings/   reads the settings of nodes                                  node_settings.hpp
///   rules/      checks units and sums, finds the running order, loops and    examine.hpp, unit_check.hpp, fan_in.hpp, order.hpp,
///               delays, and warns of what will not work well                 aliasing.hpp, lateness.hpp
///   build/      makes nodes, lays out storage, writes records                build.hpp, rate_conversions.hpp
///   steps/      what a tick does besides the nodes: sums, delays, ramps      ops.hpp, sum_step.hpp, ramps.hpp
///   swap/       decides what continues from the plan before                  plan_diff.hpp, matching.hpp, takeover.hpp

#include "plan.hpp"
#include <tactus/plan/flat/flatten.hpp>

#include <tactus/graph/graph.hpp>
#include <tactus/text/message.hpp>

namespace tactus
{

struct CompileOptions
{
    double rate_hz = 0.0;                       ///< 0: the rate of the graph
    std::vector<std::string> feeds {};          ///< ports driven from outside: "drag.position.x", "drag.mu"
    std::vector<std::string> records {};        ///< ports to tap; empty: the inputs of every sink
    std::vector<plan::Override> overrides {};   ///< values that take precedence over the file
    Assets* assets = nullptr;                   ///< loads the files that settings name
    Services services {};                       ///< services that nodes may use
    bool settles = false;                       ///< computes nodes whose inputs never change only when a param was written, not on each tick
    const Plan* before = nullptr;               ///< the plan that the new one will take over from, with Plan::takeOver
    const Plan* withdrawn = nullptr;            ///< a plan compiled to follow `before` that never ran: nodes that it added keep their turned values
    std::vector<std::string> kept {};           ///< parameters that an edit must not change, because they were turned after the edit
};

struct Compiled
{
    std::shared_ptr<Plan> plan;   ///< null if there are errors other than unknown node types
    Messages messages;
};

/// Compiles a graph. Pure: the same graph and options give the same plan, regardless of the order in which nodes and wires were
/// written. Reports all problems at once. A node of an unknown type is listed as an error, but the plan still runs with a
/// placeholder in its place. The previous plan may keep ticking meanwhile. [main thread]
Compiled compile (const graph::Graph&, const Catalogue&, const CompileOptions& = {});

/// The errors and warnings that compile() would report without options, without making a plan. Files that settings name are
/// not read, and nothing is said about them. [main thread]
Messages problemsOf (const graph::Graph&, const Catalogue&);

}   // namespace tactus
