// SPDX-License-Identifier: MIT
#include "graph_part.hpp"

#include <algorithm>
#include <array>

namespace tactus::plan
{

namespace
{
/// Notes what one command touches.
struct Toucher
{
    Touched& touched;
    const graph::Command& inverse;

    void operator() (const graph::AddNode& c) const { node (c.patch, c.node.name); }
    void operator() (const graph::RemoveNode& c) const { afterwards (c.patch); }
    void operator() (const graph::RenameNode& c) const   // all that refers to the node follows, but what a batch has touched before goes on under the new name
    {
        const auto isIt = [&] (const Touched::Cable& w) { return firstName (w.from.node) == c.name || firstName (w.to.node) == c.name; };
        if (c.patch.empty() && (touched.nodes.contains (c.name) || std::ranges::any_of (touched.wires, isIt))) node (c.patch, c.to);
    }
    void operator() (const graph::SetParam& c) const { node (c.patch, c.node, c.value && ! c.value->is_number() ? Touched::How::value : Touched::How::number); }
    void operator() (const graph::SetSetting& c) const { node (c.patch, c.node); }
    void operator() (const graph::SetOverride& c) const { node (c.patch, c.node); }
    void operator() (const graph::SetNodeKey& c) const
    {
        constexpr std::array known { "type", "role", "roles", "bypass", "overrides", "count", "every", "times", "hold" };
        if (std::ranges::count (known, c.key) == 0) return;
        if (c.key == "every" || c.key == "times") touched.everything = true;
        node (c.patch, c.node);
    }
    void operator() (const graph::AddWire& c) const { wire (c.patch, c.wire.id, c.wire, true); }
    void operator() (const graph::RemoveWire& c) const
    {
        if (const auto* back = std::get_if<graph::AddWire> (&inverse.edit)) wire (c.patch, back->wire.id, back->wire, false);
    }
    void operator() (const graph::ChangeWire& c) const
    {
        wire (c.patch, c.wire, c.to, true);
        if (const auto* back = std::get_if<graph::ChangeWire> (&inverse.edit)) wire (c.patch, c.wire, back->to, false);
    }
    void operator() (const graph::AddControl& c) const { touched.controls.insert (c.control.id); }
    void operator() (const graph::RemoveControl&) const {}
    void operator() (const graph::ChangeControl& c) const { touched.controls.insert (c.to.id); }
    void operator() (const graph::AddSubgraph& c) const { touched.patches.insert (c.name); }
    void operator() (const graph::RemoveSubgraph& c) const { touched.patches.insert (c.name); }
    void operator() (const graph::RenameSubgraph& c) const
    {
        if (touched.patches.contains (c.name)) touched.patches.insert (c.to);
    }
    void operator() (const graph::CollapseNodes&) const { touched.everything = true; }
    void operator() (const graph::ExpandNode&) const { touched.everything = true; }
    void operator() (const graph::ReplaceGraph&) const {}   // a graph that is loaded may have errors
    void operator() (const graph::ChangeExpose& c) const
    {
        if (c.patch.empty())
            touched.everything = true;   // rare: only other files use the ports that a graph exposes
        else
            touched.patches.insert (c.patch);
    }
    void operator() (const graph::SetDevice&) const {}
    void operator() (const graph::SetHeader& c) const { touched.rate = touched.rate || c.rate_hz; }
    void operator() (const graph::Batch& c) const
    {
        const auto* back = std::get_if<graph::Batch> (&inverse.edit);
        if (back == nullptr || back->commands.size() != c.commands.size())
            touched.everything = true;
        else
            for (std::size_t i = 0; i < c.commands.size(); ++i)
                std::visit (Toucher { touched, back->commands[c.commands.size() - 1 - i] }, c.commands[i].edit);
    }

private:
    void node (const std::string& patch, const std::string& name, Touched::How how = Touched::How::node) const
    {
        if (! patch.empty())
            touched.patches.insert (patch);
        else if (const auto [known, is_new] = touched.nodes.emplace (name, how); ! is_new)
            known->second = std::max (known->second, how);
    }

    void wire (const std::string& patch, graph::Id id, const graph::Wire& w, bool is_added) const
    {
        if (! patch.empty())
            touched.patches.insert (patch);
        else
            touched.wires.push_back ({ id, w.from, w.to, is_added });
    }

    /// What has lost the references to a node.
    void afterwards (const std::string& patch) const
    {
        if (! patch.empty()) touched.patches.insert (patch);
        const auto* back = std::get_if<graph::Batch> (&inverse.edit);
        if (back == nullptr) return;
        for (const auto& command : back->commands)
            if (const auto* lost = std::get_if<graph::AddWire> (&command.edit))
                wire (lost->patch, lost->wire.id, lost->wire, false);
            else if (const auto* expose = std::get_if<graph::ChangeExpose> (&command.edit))
                (*this) (*expose);
            else if (const auto* key = std::get_if<graph::SetNodeKey> (&command.edit))
                node (key->patch, key->node);
    }
};
}   // namespace

Touched touchedBy (const graph::Command& command, const graph::Command& inverse)
{
    Touched touched;
    std::visit (Toucher { touched, inverse }, command.edit);
    return touched;
}

}   // namespace tactus::plan
