// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/edit.hpp>
#include <framework/text/message.hpp>

#include <optional>
#include <string>

namespace tactus::host
{

/// What a message is about.
struct Culprit
{
    std::string patch;         ///< "" is the graph itself
    graph::Id id = 0;          ///< of the node or wire; 0 if it is about neither
    std::string node;          ///< its name, if it is a node
    std::string param, role;   ///< if it is about a param or a device role
};

Culprit culpritOf (const graph::Graph&, const Message&);

/// A one-click fix for a problem, with a short button label.
struct Fix
{
    std::string label;
    graph::Command command;
};

/// Empty if only the user can decide what to do.
std::optional<Fix> fixOf (const graph::Graph&, const Message&);

}   // namespace tactus::host
