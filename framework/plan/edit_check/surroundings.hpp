// SPDX-License-Identifier: MIT
#pragma once

#include "graph_index.hpp"

#include <tactus/node/catalogue.hpp>

#include <optional>
#include <set>
#include <string>

namespace tactus::plan
{

/// The part of a graph that decides whether a new node or wire is right: a small graph with the same errors there.
class Surroundings
{
public:
    Surroundings (const graph::Graph& g, const GraphIndex& i, const Catalogue& t) : graph (g), index (i), types (t) {}

    void addNode (int node);

    /// Adds a wire, the other wires into the same port if these may not be summed, and as much as tells the unit at both ends: ports whose
    /// units depend on each other, up to one with a fixed unit. False if that does not decide: the wire may close a loop, or an end does not
    /// exist.
    bool addNewWire (int wire);

    graph::Graph made() const;

private:
    struct Search;

    const graph::Node& node (int n) const { return graph.root.nodes[at (n)]; }
    const graph::Wire& wire (int w) const { return graph.root.wires[at (w)]; }
    const PortSheet* rowAt (int node, const std::string& port, bool starts) const;
    bool leads (int start, int goal) const;
    void addWire (int wire);
    void addSubgraph (const graph::Node&);
    void addRivals (int wire);
    void reach (int wire, bool starts, Search&) const;
    void step (Search&);

    const graph::Graph& graph;
    const GraphIndex& index;
    const Catalogue& types;
    std::set<int> nodes, wires;
    std::set<std::string> patches;   // subgraphs that the nodes use
};

/// True if all ports of a type have a fixed unit.
bool hasFixedUnits (const NodeType&);

}   // namespace tactus::plan
