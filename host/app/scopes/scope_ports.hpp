// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_model.hpp"

#include <host/app/location/scope_port.hpp>
#include <tactus/run/probe_ring.hpp>

namespace tactus::host
{

/// The scopes for a newly opened graph: the force that the hand gets over time, force against displacement, and energy. Leaves out
/// scopes for which the graph has no ports, and the one for energy if more than most_energies ports report one, or if there are several
/// instances of the hand, whose energies cannot be told apart.
std::vector<ScopeSpec> suggestedScopes (const graph::Graph&, const Catalogue&);

/// A scope of a kind, with suitable ports of the graph; of the first instance, if it can show only one.
ScopeSpec suggestedScope (ScopeKind, const graph::Graph&, const Catalogue&);

/// The ports of all nodes that report stored or dissipated energy.
std::vector<std::string> energyPorts (const std::vector<ScopePort>&);

constexpr std::size_t most_energies = ProbeRing::most - 6;   ///< that can be recorded next to the position of the hand and the force on it

/// The state port (stuck or sliding) of the node that a port belongs to, or else of the first friction node; "" if there is none.
std::string stateFor (const std::string& port, const std::vector<ScopePort>&);

/// Updates the port names after an edit that renamed, grouped or moved nodes, by node id. Names of removed nodes are kept.
void follow (ScopeModel&, const std::vector<ScopePort>& before, const std::vector<ScopePort>& after);

/// Finds ports by name, however many there are.
class PortNames
{
public:
    PortNames() = default;
    explicit PortNames (const std::vector<ScopePort>&);

    /// True if a port, or a component of one, is among the ports.
    bool has (const std::string& port) const;

private:
    std::vector<std::string> sorted;
};

}   // namespace tactus::host
