// SPDX-License-Identifier: MIT
#pragma once

#include "directory.hpp"
#include "plan.hpp"

#include <memory>

namespace tactus
{
struct CompileOptions;
}

namespace tactus::plan
{

/// Compiles an edit of a few wires without visiting the whole graph. The new plan shares its nodes, records, outputs and inputs with
/// the previous plan, except those of the nodes where the wires end. The result is the same as compiling everything.
///
/// Returns null if everything must be compiled:
///  - The graph's Trail does not lead from the previous plan to the graph. Only the graph of a History has such a trail.
///  - A file that a setting names has changed.
///  - There are messages or sections.
///  - A wire is delayed, begins or ends in a subgraph, changes the running order, or may change the units of other ports.
///  - There have been many such edits. Each plan keeps the storage of the plans before it, so now and then everything is compiled.
std::shared_ptr<Plan> rewire (const graph::Graph&, const Catalogue&, const CompileOptions&);

/// Notes what rewire() needs later. Takes the names of the scope and the checks of the files. [main thread]
void remember (Background&, Scope& top, Flat&, const CompileOptions&);

/// The last step of compiling a whole graph: the plan knows the version of the graph, and whether there were messages.
void finish (Plan&, Background&, PortUnits, graph::Id version, bool is_clean);

}   // namespace tactus::plan
