// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"
#include "names.hpp"
#include "unit_check.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// What compiling has found out about a graph, and what stays true after an edit of a few wires. Plans that differ only by such
/// edits share it; see rewire.hpp. [main thread]
struct Background
{
    std::vector<std::string> feeds, records;   ///< as in CompileOptions
    std::size_t lanes = 1;                     ///< as in CompileOptions
    bool settles = false;                      ///< as in CompileOptions
    bool is_plain = false;                     ///< no messages, overrides, sections or bypassed subgraphs
    FileChecks files;                          ///< the files that settings name, also those of unused subgraphs
    Names names;                               ///< of the nodes of the graph itself
    std::vector<int> nodes;                    ///< by name: number of the node; -1 for a subgraph or a placeholder
    PortUnits units;                           ///< PortNumbers::flat belongs to no plan
    std::vector<int> rank;                     ///< by node: its rank in order of path, which decides ties in the running order
    std::vector<int> running, position;        ///< the nodes in running order; by node: its place in that order
    std::vector<bool> settled;                 ///< by node; see settled_nodes.hpp
    std::vector<PortRef> tapped;               ///< by tap: the component that it reads; without a node if it belongs to a placeholder
};

/// A compact copy of the wires of a flat graph, by number, so that searches need not visit the wires themselves.
struct WireEnds
{
    std::vector<graph::Id> ids;
    std::vector<std::pair<int, int>> ends;   ///< the nodes at both ends; -1 for the output of a placeholder

    void add (const FlatWire& w)
    {
        ids.push_back (w.identity.id);
        ends.emplace_back (w.from ? w.from->node : -1, w.to.node);
    }
};

}   // namespace tactus::plan
