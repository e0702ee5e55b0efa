// SPDX-License-Identifier: MIT
#include "graph_index.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace tactus::plan
{

namespace
{
/// The element with this key in a list, near the place where it was last; only removed and inserted elements have moved the others.
template <typename Element, typename Key>
const Element* near (const std::vector<Element>& list, std::size_t& place, const Key& key, Key Element::*member)
{
    constexpr std::size_t farthest = 64;
    for (std::size_t d = 0; d <= farthest; ++d)
        for (const auto i : { place - d, place + d })   // wraps to a large number below 0
            if (i < list.size() && list[i].*member == key)
            {
                place = i;
                return &list[i];
            }
    const auto found = std::ranges::find (list, key, member);
    if (found == list.end()) return nullptr;
    place = static_cast<std::size_t> (found - list.begin());
    return &*found;
}

}   // namespace

/// Follows one edit. Returns false if the wiring must be made again.
struct GraphIndexFollower
{
    GraphIndex& to;
    const graph::Command& inverse;

    bool operator() (const graph::AddWire& c) const
    {
        if (c.patch.empty()) to.add (c.wire, c.place.value_or (to.wires.size()));
        return c.patch.empty();
    }
    bool operator() (const graph::RemoveWire& c) const
    {
        if (c.patch.empty()) removeWiresOf (inverse);
        return true;
    }
    bool operator() (const graph::ChangeWire& c) const
    {
        if (! c.patch.empty()) return false;
        auto wire = c.to;
        wire.id = c.wire;
        const auto known = to.wires.find (c.wire);
        const auto place = known != to.wires.end() ? known->second.place : 0;
        to.remove (c.wire);
        to.add (wire, place);
        return true;
    }
    bool operator() (const graph::AddNode& c) const
    {
        to.note (c.node);
        if (c.patch.empty()) to.links[c.node.name].place = c.place.value_or (to.nodes);
        ++to.nodes;
        return true;
    }
    bool operator() (const graph::RemoveNode&) const
    {
        removeWiresOf (inverse);
        return true;
    }
    bool operator() (const graph::SetNodeKey& c) const
    {
        if (c.key == "every" || c.key == "times") to.has_sections = true;
        return c.key != "type";
    }
    bool operator() (const graph::SetParam&) const { return true; }
    bool operator() (const graph::SetSetting&) const { return true; }
    bool operator() (const graph::SetOverride&) const { return true; }
    bool operator() (const graph::AddControl&) const { return true; }
    bool operator() (const graph::RemoveControl&) const { return true; }
    bool operator() (const graph::ChangeControl&) const { return true; }
    bool operator() (const graph::ChangeExpose&) const { return false; }
    bool operator() (const graph::SetDevice&) const { return true; }
    bool operator() (const graph::SetHeader&) const { return true; }
    bool operator() (const graph::Batch& c) const
    {
        const auto* back = std::get_if<graph::Batch> (&inverse.edit);
        if (back == nullptr || back->commands.size() != c.commands.size()) return false;
        for (std::size_t i = 0; i < c.commands.size(); ++i)
            if (! std::visit (GraphIndexFollower { to, back->commands[c.commands.size() - 1 - i] }, c.commands[i].edit)) return false;
        return true;
    }

    template <typename Other>
    bool operator() (const Other&) const
    {
        return false;
    }

private:
    void removeWiresOf (const graph::Command& back) const
    {
        if (const auto* wire = std::get_if<graph::AddWire> (&back.edit); wire != nullptr && wire->patch.empty()) to.remove (wire->wire.id);
        if (const auto* batch = std::get_if<graph::Batch> (&back.edit))
            for (const auto& command : batch->commands)
                removeWiresOf (command);
    }
};

void GraphIndex::follow (const graph::Command& command, const graph::Command& inverse)
{
    if (is_known) is_known = std::visit (GraphIndexFollower { *this, inverse }, command.edit);
}

void GraphIndex::see (const graph::Graph& now)
{
    graph = &now;
    if (is_known) return;
    const int count = made + 1;
    *this = {};
    made = count;
    graph = &now;
    is_known = true;
    nodes = now.root.nodes.size();
    links.reserve (now.root.nodes.size());
    wires.reserve (now.root.wires.size());
    for (std::size_t i = 0; i < now.root.nodes.size(); ++i)
    {
        note (now.root.nodes[i]);
        links[now.root.nodes[i].name].place = i;
    }
    for (std::size_t i = 0; i < now.root.wires.size(); ++i)
        add (now.root.wires[i], i);
    for (const auto& [name, patch] : now.graphs)
        note (patch);
    if (! now.files.empty())
        has_sections = joins_inside = true;   // perhaps
}

const graph::Node* GraphIndex::node (const std::string& name) const
{
    const auto known = links.find (name);
    return known == links.end() ? graph->root.find (name) : near (graph->root.nodes, known->second.place, name, &graph::Node::name);
}

const graph::Wire* GraphIndex::wire (graph::Id id) const
{
    const auto known = wires.find (id);
    return known == wires.end() ? nullptr : near (graph->root.wires, known->second.place, id, &graph::Wire::id);
}

const GraphIndex::Links& GraphIndex::at (const std::string& name) const
{
    static const Links none;
    const auto known = links.find (name);
    return known == links.end() ? none : known->second;
}

void GraphIndex::add (const graph::Wire& wire, std::size_t place)
{
    Ends ends { firstName (wire.from.node), firstName (wire.to.node), {}, place };
    ends.head = ends.to + '.' + wire.to.port + '[' + std::to_string (wire.to.index);
    if (wire.to.node.find ('/') != std::string::npos) joins_inside = true;   // perhaps
    if (++heads[ends.head] == 2) joints.push_back ({ ends.to, wire.to.port });
    links[ends.to].in.push_back (wire.id);
    links[ends.from].out.push_back (wire.id);
    wires.insert_or_assign (wire.id, std::move (ends));
}

void GraphIndex::remove (graph::Id id)
{
    const auto known = wires.find (id);
    if (known == wires.end()) return;
    --heads[known->second.head];
    std::erase (links[known->second.from].out, id);
    std::erase (links[known->second.to].in, id);
    wires.erase (known);
}

void GraphIndex::note (const graph::Node& node)
{
    if (node.isSubgraph() && (node.extra.contains ("every") || node.extra.contains ("times"))) has_sections = true;
}

void GraphIndex::note (const graph::Patch& patch)
{
    std::ranges::for_each (patch.nodes, [this] (const auto& n) { note (n); });
    std::set<std::pair<std::string_view, std::string_view>> ends;
    const auto end = [&] (const graph::Endpoint& e) {
        const bool is_new = ends.emplace (e.node, e.port).second;
        joins_inside = joins_inside || ! is_new || e.node.find ('/') != std::string::npos;
    };
    for (const auto& w : patch.wires)
        end (w.to);
    for (const auto* exposed : { &patch.expose.inputs, &patch.expose.params })
        for (const auto& [name, e] : *exposed)
            end (e);
}

}   // namespace tactus::plan
