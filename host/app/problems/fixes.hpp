// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/edit.hpp>
#include <framework/message.hpp>

#include <optional>
#include <string>

namespace tactus::host
{

/// What in a graph a message is about.
struct Culprit
{
    std::string patch;         ///< "" is the graph itself
    graph::Id id = 0;          ///< of the node or wire; 0 if it is about neither
    std::string node;          ///< its name, if it is one
    std::string param, role;   ///< if it is about one of its params, or a device role
};

Culprit culpritOf (const graph::Graph&, const Message&);

/// What would end a problem, with as few words as a button has.
struct Fix
{
    std::string label;
    graph::Command command;
};

/// Nothing where only the user knows what was meant.
std::optional<Fix> fixOf (const graph::Graph&, const Message&);

}   // namespace tactus::host
