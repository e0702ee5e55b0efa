// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/text/message.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// Splits a JSON pointer such as "/nodes/drag/params/mu" into its parts, unescaped (RFC 6901).
std::vector<std::string> pointerParts (const std::string&);

/// The part of a graph that a message is about.
struct ProblemLocation
{
    std::string patch;         ///< "" is the graph itself
    graph::Id id = 0;          ///< id of the node or wire; 0 if the message is about neither
    std::string node;          ///< name of the node, if the message is about one
    std::string param, role;   ///< name of the param or device role, if the message is about one
    std::string setting;       ///< name of the setting, if the message is about one
    std::string within;        ///< JSON pointer to the part of that setting
};

ProblemLocation locationOf (const graph::Graph&, const Message&);

}   // namespace tactus::host
