// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/edit.hpp>
#include <tactus/text/message.hpp>

#include <optional>
#include <string>

namespace tactus::host
{

/// What a message is about.
struct ProblemLocation
{
    std::string patch;         ///< "" is the graph itself
    graph::Id id = 0;          ///< id of the node or wire; 0 if the message is about neither
    std::string node;          ///< name of the node, if the message is about one
    std::string param, role;   ///< name of the param or device role, if the message is about one
};

ProblemLocation locationOf (const graph::Graph&, const Message&);

/// A one-click fix for a problem, with a short button label.
struct Fix
{
    std::string label;
    graph::Command command;
};

/// Empty if only the user can decide what to do.
std::optional<Fix> fixOf (const graph::Graph&, const Message&);

}   // namespace tactus::host
