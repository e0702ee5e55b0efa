// SPDX-License-Identifier: GPL-3.0-or-later
#include "quantities.hpp"

#include <framework/graph/inside.hpp>

namespace tactus::host
{

namespace
{
/// True if the unit of a generic port is that of another one, times nothing.
bool follows (const UnitRule& rule) { return rule.kind == UnitRule::Kind::same && rule.unit.dimension == Dimension {}; }

/// "in" of "in[2]".
std::string_view baseOf (std::string_view id) { return id.substr (0, id.find ('[')); }

std::size_t at (int i) { return static_cast<std::size_t> (i); }

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
}

Quantity Quantities::of (const graph::Patch& patch, std::size_t node, Role role, std::string_view port) const
{
    const auto& seat = rows.at (&patch).seats[node];
    const int number = numberOf (seat, seat.face.find (role, port));
    return number < 0 ? Quantity::any : known[at (root (number))];
}

void Quantities::visit (const graph::Graph& owner, const graph::Patch& patch)
{
    const auto [place, is_new] = rows.try_emplace (&patch);
    if (! is_new) return;
    auto& [seats, by_name] = place->second;
    for (const auto& node : patch.nodes)
    {
        by_name.emplace (node.name, seats.size());
        seats.push_back ({ faceOf (owner, patch, node, catalogue), static_cast<int> (towards.size()) });
        eachPort (seats.back().face, [&] (const FacePort& port)
                  {
            towards.push_back (static_cast<int> (towards.size()));
            known.push_back (port.quantity()); });
    }
    for (const auto& seat : seats)
        followNode (seat);
    followWires (patch);
    followInside (owner, patch);
}

void Quantities::followNode (const Seat& seat)
{
    eachPort (seat.face, [&] (const FacePort& port)
              { eachPort (seat.face, [&] (const FacePort& other)
                          {
        const bool follows_it = follows (port.unit) && port.unit.a == baseOf (other.id);
        const bool both_open = port.unit.kind == UnitRule::Kind::open && other.unit.kind == UnitRule::Kind::open && baseOf (port.id) == baseOf (other.id);
        if (follows_it || both_open) join (numberOf (seat, &port), numberOf (seat, &other)); }); });
}

void Quantities::followWires (const graph::Patch& patch)
{
    for (const auto& wire : patch.wires)
    {
        const auto *from = seatOf (patch, wire.from.node), *to = seatOf (patch, wire.to.node);
        const bool keeps = wire.gain.is_null();   // a gain may have a unit
        if (from != nullptr && to != nullptr && keeps) join (numberOf (*from, from->face.startOf (wire.from)), numberOf (*to, to->face.endOf (wire.to)));
    }
}

void Quantities::followInside (const graph::Graph& owner, const graph::Patch& patch)
{
    for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    {
        const auto [its_owner, inside] = graph::insideOf (owner, patch.nodes[i]);
        if (inside == nullptr) continue;
        visit (*its_owner, *inside);
        const auto& outer = rows.at (&patch).seats[i];
        const auto meet = [&] (const std::vector<std::pair<std::string, graph::Endpoint>>& names, Role role)
        {
            for (const auto& [name, end] : names)
                if (const auto* seat = seatOf (*inside, end.node)) join (numberOf (outer, outer.face.find (role, name)), numberOf (*seat, role == Role::output ? seat->face.startOf (end) : seat->face.endOf (end)));
        };
        meet (inside->expose.inputs, Role::input);
        meet (inside->expose.params, Role::param);
        meet (inside->expose.outputs, Role::output);
    }
}

const Quantities::Seat* Quantities::seatOf (const graph::Patch& patch, std::string_view name) const
{
    const auto& row = rows.at (&patch);
    const auto node = row.by_name.find (name);
    return node == row.by_name.end() ? nullptr : &row.seats[node->second];
}

int Quantities::numberOf (const Seat& seat, const FacePort* port)
{
    if (port == nullptr) return -1;
    int number = seat.first;
    for (const auto* ports : { &seat.face.inputs, &seat.face.params, &seat.face.outputs })
    {
        if (! ports->empty() && port >= ports->data() && port <= &ports->back()) return number + static_cast<int> (port - ports->data());
        number += static_cast<int> (ports->size());
    }
    return -1;
}

int Quantities::root (int port) const
{
    while (towards[at (port)] != port)
        port = towards[at (port)];
    return port;
}

/// What is known first is what the ports are shown to carry, should they not agree.
void Quantities::join (int a, int b)
{
    if (a < 0 || b < 0) return;
    const int x = root (a), y = root (b);
    if (x == y) return;
    towards[at (y)] = x;
    if (known[at (x)] == Quantity::any) known[at (x)] = known[at (y)];
}

}   // namespace tactus::host
