// SPDX-License-Identifier: MIT
#pragma once

/// The part of a graph that an edit touches, as a small graph that has the same errors there.

#include "graph_index.hpp"

#include <tactus/node/catalogue.hpp>
#include <tactus/text/message.hpp>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::plan
{

/// What an edit touches, in the graph itself.
struct Touched
{
    enum class How
    {
        number,   ///< a value of the node is now a plain number
        value,    ///< a value of the node is now something that may have a unit
        node      ///< anything else: the node may have other ports, and its wires may fit no longer
    };

    /// A wire that was added, removed or changed.
    struct Cable
    {
        graph::Id id;
        graph::Endpoint from, to;
        bool is_added;
    };

    bool everything = false;
    bool rate = false;
    std::map<std::string, How> nodes {};
    std::vector<Cable> wires {};
    std::set<std::string> controls {};
    std::set<std::string> patches {};   ///< subgraphs; each is touched as a whole

    bool isNothing() const noexcept { return ! everything && ! rate && nodes.empty() && wires.empty() && controls.empty() && patches.empty(); }
};

/// `inverse` undoes the command.
Touched touchedBy (const graph::Command&, const graph::Command& inverse);

struct Part
{
    graph::Graph graph;
    std::vector<std::size_t> numbers;   ///< by wire: its number in the whole graph

    /// Translates the place of a message.
    void giveNumbers (Message&) const;
};

/// Contains what is touched, the other ends of its wires, the ports whose units depend on it, and the loops that it closes. With
/// `joins`, all ports whose quantity depends on it, too.
Part partOf (const graph::Graph&, const Touched&, const Catalogue&, const GraphIndex&, bool joins);

/// The row of a port; null if there is none.
const PortSheet* rowOf (const NodeType&, std::string_view port, Role);

}   // namespace tactus::plan
