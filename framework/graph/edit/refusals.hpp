// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>

#include <string>

namespace tactus::graph
{

// The reasons why an edit is refused; edit.hpp lists the ids. `patch` is the name of a subgraph, or "" for the graph itself.

/// "/nodes", or "/graphs/grain/nodes" for the subgraph "grain".
std::string placeIn (const std::string& patch, const std::string& list);

Message noPatch (const std::string& name);
Message noNode (const std::string& patch, const std::string& name);
Message noWire (const std::string& patch);
Message noControl (const std::string& id);
Message badId (const std::string& id);
Message nameTaken (const std::string& what, const std::string& name);   ///< what: "a node", "a control", "a subgraph"
Message subgraphTaken (const std::string& name);                        ///< also if a node already uses a subgraph of that name
Message idTaken (const std::string& what, const std::string& name);     ///< what: "node" or "wire"

}   // namespace tactus::graph
