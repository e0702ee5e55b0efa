// SPDX-License-Identifier: MIT
#include <tactus/graph/edit.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <tactus/text/quote.hpp>

namespace tactus::graph
{
namespace
{
struct Namer
{
    std::string operator() (const AddNode& c) const { return "add " + quote (c.node.name); }
    std::string operator() (const RemoveNode& c) const { return "remove " + quote (c.name); }
    std::string operator() (const RenameNode& c) const { return "rename " + quote (c.name) + " to " + quote (c.to); }
    std::string operator() (const SetParam& c) const { return (c.value ? "set " : "reset ") + quote (c.node + "." + c.param); }
    std::string operator() (const SetSetting& c) const { return (c.value ? "set " : "reset ") + quote (c.node + "." + c.setting); }
    std::string operator() (const SetOverride& c) const
    {
        return (c.value ? "set " : "reset ") + quote (c.node + (c.path.starts_with ('[') ? "" : "/") + c.path);
    }
    std::string operator() (const SetNodeKey& c) const { return "change " + c.key + " of " + quote (c.node); }
    std::string operator() (const AddWire& c) const { return "add wire " + quote (toText (c.wire)); }
    std::string operator() (const RemoveWire&) const { return "remove wire"; }
    std::string operator() (const ChangeWire& c) const { return "change wire to " + quote (toText (c.to)); }
    std::string operator() (const AddControl& c) const { return "add control " + quote (c.control.id); }
    std::string operator() (const RemoveControl& c) const { return "remove control " + quote (c.control); }
    std::string operator() (const ChangeControl& c) const { return "change control " + quote (c.control); }
    std::string operator() (const AddSubgraph& c) const { return "add subgraph " + quote (c.name); }
    std::string operator() (const RemoveSubgraph& c) const { return "remove subgraph " + quote (c.name); }
    std::string operator() (const RenameSubgraph& c) const { return "rename subgraph " + quote (c.name) + " to " + quote (c.to); }
    std::string operator() (const CollapseNodes& c) const { return "collapse to " + quote (c.name); }
    std::string operator() (const ExpandNode& c) const { return "expand " + quote (c.name); }
    std::string operator() (const ReplaceGraph&) const { return "replace the graph"; }
    std::string operator() (const ChangeExpose&) const { return "change exposed ports"; }
    std::string operator() (const SetDevice& c) const { return (c.description ? "set device " : "remove device ") + quote (c.role); }
    std::string operator() (const SetHeader&) const { return "change the graph's header"; }
    std::string operator() (const Batch& c) const { return c.name; }
};
}   // namespace

std::string nameOf (const Command& command) { return std::visit (Namer(), command.edit); }

}   // namespace tactus::graph
