// SPDX-License-Identifier: GPL-3.0-or-later
#include "quantities.hpp"

#include <tactus/graph/inside.hpp>
#include <tactus/kit/at.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// True if a generic port has the same unit as another one, without a factor.
bool follows (const UnitRule& rule) { return rule.kind == UnitRule::Kind::same && rule.unit.dimension == Dimension {}; }

/// Drops the index: "in[2]" becomes "in".
std::string_view withoutIndex (std::string_view id) { return id.substr (0, id.find ('[')); }

template <typename Visit>
void eachPort (const Face& face, Visit visit)
{
    for (const auto* ports : { &face.inputs, &face.params, &face.outputs })
        for (const auto& port : *ports)
            visit (port);
}
}   // namespace

Quantities::Quantities (const graph::Graph& graph, const Catalogue& c) : catalogue (c)
{
    visit (graph, graph.root);
    for (const auto& [name, patch] : graph.graphs)
        visit (graph, patch);
    while (joinProducts())
    {
    }
    for (auto& port : parent)
        port = root (port);
}

Quantity Quantities::of (const graph::Patch& patch, std::size_t node, Role role, std::string_view port) const
{
    const auto& node_ports = patches.at (&patch).nodes[node];
    const int number = numberOf (node_ports, node_ports.face.find (role, port));
    return number < 0 ? Quantity::any : known[at (parent[at (number)])];
}

void Quantities::visit (const graph::Graph& owner, const graph::Patch& patch)
{
    const auto [place, is_new] = patches.try_emplace (&patch);
    if (! is_new) return;
    auto& [nodes, by_name] = place->second;
    for (const auto& node : patch.nodes)
    {
        by_name.emplace (node.name, nodes.size());
        nodes.push_back ({ faceOf (owner, patch, node, catalogue), static_cast<int> (parent.size()) });
        eachPort (nodes.back().face, [&] (const FacePort& port) {
            parent.push_back (static_cast<int> (parent.size()));
            known.push_back (port.quantity());
        });
    }
    for (const auto& node_ports : nodes)
        joinPortsOf (node_ports);
    joinAlongWires (patch);
    joinWithInside (owner, patch);
}

void Quantities::joinPortsOf (const NodePorts& node_ports)
{
    eachPort (node_ports.face, [&] (const FacePort& port) {
        if (! follows (port.unit) && port.unit.kind != UnitRule::Kind::open) return;
        eachPort (node_ports.face, [&] (const FacePort& other) {
            const bool follows_it = follows (port.unit) && port.unit.a == withoutIndex (other.id);
            const bool both_open = port.unit.kind == UnitRule::Kind::open && other.unit.kind == UnitRule::Kind::open
                                   && withoutIndex (port.id) == withoutIndex (other.id);
            if (follows_it || both_open) join (numberOf (node_ports, &port), numberOf (node_ports, &other));
        });
    });
}

/// A product with a gain, or with an input that nothing drives, carries what its other factor does. Returns true if that joined anything.
bool Quantities::joinProducts()
{
    bool has_joined = false;
    for (const auto& [patch, ports] : patches)
        for (const auto& node_ports : ports.nodes)
            for (const auto& port : node_ports.face.outputs)
            {
                if (port.unit.kind != UnitRule::Kind::product || port.unit.b.empty()) continue;
                const auto *a = node_ports.face.find (Role::input, port.unit.a), *b = node_ports.face.find (Role::input, port.unit.b);
                if (a == nullptr || b == nullptr) continue;
                const int product = root (numberOf (node_ports, &port));
                const auto joins = [&, patch = patch] (const FacePort* factor, const FacePort* other) {
                    const int y = root (numberOf (node_ports, other));
                    const bool is_open = known[at (product)] == Quantity::any || known[at (y)] == Quantity::any;   // else, the graph has an error
                    if (! is_open || ! isPlainFactor (*patch, node_ports, *factor)) return false;
                    join (product, y);
                    return true;
                };
                // With one factor only: the other one is free to carry anything.
                const bool is_joined = product == root (numberOf (node_ports, a)) || product == root (numberOf (node_ports, b));
                if (! is_joined && (joins (b, a) || joins (a, b))) has_joined = true;
            }
    return has_joined;
}

bool Quantities::isPlainFactor (const graph::Patch& patch, const NodePorts& node_ports, const FacePort& port)
{
    const auto quantity = known[at (root (numberOf (node_ports, &port)))];
    if (quantity != Quantity::any) return quantity == Quantity::gain || quantity == Quantity::state;
    const auto isHere = [&] (const graph::Endpoint& end) {
        const auto* to = portsOf (patch, end.node);
        return to == &node_ports && to->face.endOf (end) == &port;
    };
    return std::ranges::none_of (patch.wires, [&] (const graph::Wire& w) { return isHere (w.to); })
           && std::ranges::none_of (patch.expose.inputs, [&] (const auto& exposed) { return isHere (exposed.second); });
}

void Quantities::joinAlongWires (const graph::Patch& patch)
{
    for (const auto& wire : patch.wires)
    {
        const auto *from = portsOf (patch, wire.from.node), *to = portsOf (patch, wire.to.node);
        const bool keeps = wire.gain.is_null();   // a gain may have a unit, and so change the quantity
        if (from != nullptr && to != nullptr && keeps) join (numberOf (*from, from->face.startOf (wire.from)), numberOf (*to, to->face.endOf (wire.to)));
    }
}

void Quantities::joinWithInside (const graph::Graph& owner, const graph::Patch& patch)
{
    for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    {
        const auto [its_owner, inside] = graph::insideOf (owner, patch.nodes[i]);
        if (inside == nullptr) continue;
        visit (*its_owner, *inside);
        const auto& outer = patches.at (&patch).nodes[i];
        const auto joinExposed = [&, inside = inside] (const std::vector<std::pair<std::string, graph::Endpoint>>& names, Role role) {
            for (const auto& [name, end] : names)
                if (const auto* inner = portsOf (*inside, end.node))
                {
                    const auto* port = role == Role::output ? inner->face.startOf (end) : inner->face.endOf (end);
                    join (numberOf (outer, outer.face.find (role, name)), numberOf (*inner, port));
                }
        };
        joinExposed (inside->expose.inputs, Role::input);
        joinExposed (inside->expose.params, Role::param);
        joinExposed (inside->expose.outputs, Role::output);
    }
}

const Quantities::NodePorts* Quantities::portsOf (const graph::Patch& patch, std::string_view name) const
{
    const auto& ports = patches.at (&patch);
    const auto node = ports.by_name.find (name);
    return node == ports.by_name.end() ? nullptr : &ports.nodes[node->second];
}

int Quantities::numberOf (const NodePorts& node_ports, const FacePort* port)
{
    if (port == nullptr) return -1;
    int number = node_ports.first;
    for (const auto* ports : { &node_ports.face.inputs, &node_ports.face.params, &node_ports.face.outputs })
    {
        if (! ports->empty() && port >= ports->data() && port <= &ports->back()) return number + static_cast<int> (port - ports->data());
        number += static_cast<int> (ports->size());
    }
    return -1;
}

int Quantities::root (int port)
{
    while (parent[at (port)] != port)
        port = parent[at (port)] = parent[at (parent[at (port)])];
    return port;
}

/// Notes that two ports carry the same quantity. If their quantities differ, that of the first port is shown.
void Quantities::join (int a, int b)
{
    if (a < 0 || b < 0) return;
    const int x = root (a), y = root (b);
    if (x == y) return;
    parent[at (y)] = x;
    if (known[at (x)] == Quantity::any) known[at (x)] = known[at (y)];
}

}   // namespace tactus::host
