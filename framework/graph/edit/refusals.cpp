// SPDX-License-Identifier: MIT
#include "refusals.hpp"

#include <tactus/graph/meant.hpp>

#include <tactus/text/quote.hpp>

namespace tactus::graph
{

namespace
{
std::string inside (const std::string& patch) { return patch.empty() ? "" : " in the subgraph " + quote (patch); }
}   // namespace

std::string placeIn (const std::string& patch, const std::string& list) { return (patch.empty() ? "" : "/graphs/" + patch) + '/' + list; }

Message noPatch (const std::string& name)
{
    return Message::error ("edit/unknown_patch", "/graphs", "there is no subgraph " + quote (name),
                           "name a subgraph under `graphs`, or leave the name empty for the graph itself");
}

Message noNode (const std::string& patch, const std::string& name)
{
    return Message::error ("edit/unknown_node", placeIn (patch, "nodes"), "there is no node " + quote (name) + inside (patch),
                           "add the node first, or name one that exists");
}

Message noWire (const std::string& patch)
{
    return Message::error ("edit/unknown_wire", placeIn (patch, "wires"), "the wire no longer exists" + inside (patch), "name a wire that exists");
}

Message noControl (const std::string& id)
{
    return Message::error ("edit/unknown_control", "/controls", "there is no control " + quote (id), "add the control first, or name one that exists");
}

Message badId (const std::string& id)
{
    return Message::error ("graph/bad_id", {}, quote (id) + " is not an id", idRemedy (id));
}

Message nameTaken (const std::string& what, const std::string& name)
{
    return Message::error ("edit/name_taken", {}, what + " called " + quote (name) + " already exists", "choose another name");
}

Message subgraphTaken (const std::string& name)
{
    return Message::error ("edit/name_taken", "/graphs/" + name,
                           "a subgraph called " + quote (name) + ", or a node that uses a subgraph called " + quote (name) + ", already exists",
                           "choose another name");
}

Message idTaken (const std::string& what, const std::string& name)
{
    return Message::error ("edit/id_taken", what == "wire" ? "/wires" : "/nodes/" + name, "the " + what + ' ' + quote (name) + " has the same id as another node or wire of the graph",
                           "give the copy a new id with newId()");
}

}   // namespace tactus::graph
