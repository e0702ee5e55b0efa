// SPDX-License-Identifier: MIT
#include "refusals.hpp"

#include "meant.hpp"

#include <tactus/text/quote.hpp>

namespace tactus::graph
{

namespace
{
std::string inside (const std::string& patch) { return patch.empty() ? "" : " in the subgraph " + quote (patch); }
}   // namespace

Message noPatch (const std::string& name) { return Message::error ("edit/unknown_patch", {}, "there is no subgraph " + quote (name)); }
Message noNode (const std::string& patch, const std::string& name)
{
    return Message::error ("edit/unknown_node", {}, "there is no node " + quote (name) + inside (patch));
}

Message noWire (const std::string& patch) { return Message::error ("edit/unknown_wire", {}, "the wire no longer exists" + inside (patch)); }
Message noControl (const std::string& id) { return Message::error ("edit/unknown_control", {}, "there is no control " + quote (id)); }
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
    return Message::error ("edit/name_taken", {},
                           "a subgraph called " + quote (name) + ", or a node that uses a subgraph called " + quote (name) + ", already exists",
                           "choose another name");
}

Message idTaken (const std::string& what, const std::string& name)
{
    return Message::error ("edit/id_taken", {}, "the " + what + ' ' + quote (name) + " has the same id as another node or wire of the graph",
                           "give the copy a new id with newId()");
}

}   // namespace tactus::graph
