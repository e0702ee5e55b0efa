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

/// Compiles an edit of a few wires without visiting the whole graph: the new plan shares its nodes, records, outputs and inputs with
/// the plan before, except for those of the nodes where the wires end. The result is the same as that of compiling everything.
///
/// Returns null if everything must be compiled. That is so if the graph's Trail does not lead from the plan before to the graph as it
/// is, which only a History can vouch for; if a file that a setting names has changed; if there are messages or sections; if a wire is
/// delayed, begins or ends in a subgraph, changes the running order, or may change the units of other ports; and once in a while,
/// because each such plan keeps the storage of those before it.
std::shared_ptr<Plan> rewire (const graph::Graph&, const Catalogue&, const CompileOptions&);

/// Notes what rewire() needs later. Takes the names of the scope and the checks of the files. [main thread]
void remember (Background&, Scope& top, Flat&, const CompileOptions&);

/// The last step of compiling a whole graph: the plan knows the version of the graph, and whether there were messages.
void finish (Plan&, Background&, PortUnits, graph::Id version, bool is_clean);

}   // namespace tactus::plan
