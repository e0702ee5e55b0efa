// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_model.hpp"

#include <host/app/model/face.hpp>

namespace tactus::host
{

/// A port that can be probed.
struct ScopePort
{
    std::string name;   ///< "drag.force", "grain/wave.value"
    std::string path;   ///< "grain/wave"
    graph::Id node = 0;
    std::string type;   ///< of the node, in the catalogue
    FacePort port;
};

/// All that can be probed in a graph, and in its subgraphs, node by node in the order of the file; outputs first.
std::vector<ScopePort> scopePorts (const graph::Graph&, const Catalogue&);

/// What a newcomer wants to see of a graph: the force of the motor over time, force over displacement, and where the energy
/// goes; as far as there is such a thing.
std::vector<ScopeSpec> suggestedScopes (const graph::Graph&, const Catalogue&);

/// A scope of a kind, showing what is next to hand.
ScopeSpec suggestedScope (ScopeKind, const graph::Graph&, const Catalogue&);

/// The ports of all nodes that say what energy they store or dissipate.
std::vector<std::string> energyPorts (const std::vector<ScopePort>&);

/// The port that tells whether the node of a port sticks or slides, else that of the first friction node; "" if none does.
std::string stateFor (const std::string& port, const std::vector<ScopePort>&);

/// Where ports have got to by an edit that renamed, grouped or moved their nodes: ids stay. What is simply gone stays, too.
void follow (ScopeModel&, const std::vector<ScopePort>& before, const std::vector<ScopePort>& after);

/// A port or a component of one is still in a graph.
bool isThere (const std::string& port, const std::vector<ScopePort>&);

}   // namespace tactus::host
