// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/history.hpp>
#include <tactus/node/catalogue.hpp>

#include <map>
#include <set>
#include <string>

namespace tactus::host
{

/// The name of a step of a history. If a step changes only one value, its name contains the
/// old and the new value: "wall: Stiffness 400 -> 550 N/m". The name of a new wire is the wire: "grating.force -> mixer.in[1]".
std::string stepName (const graph::History&, std::size_t step, const Catalogue&);

/// True for a command that changes only where nodes are on the canvas.
bool onlyMoves (const graph::Command&);

/// The nodes and wires of a patch that a step changes. Some may be gone after the step, or before it.
struct StepParts
{
    std::set<std::string> nodes;
    std::set<graph::Id> wires;
};

/// By patch; empty if the step changes nothing that a patch shows, such as a control.
std::map<std::string, StepParts> partsOf (const graph::History&, std::size_t step);

}   // namespace tactus::host
