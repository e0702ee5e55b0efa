// SPDX-License-Identifier: MIT
#include "keeps_units.hpp"

#include <algorithm>
#include <vector>

namespace tactus::plan
{

namespace
{
using Kind = UnitRule::Kind;

bool isFixed (const Flat& flat, const PortRef& r) { return flat.sheet (r).unit.kind == Kind::fixed; }

/// Products carry dimensions in both directions, so their ports are not judged here.
bool isInProduct (const Flat& flat, const PortRef& r)
{
    const auto isProduct = [] (const PortSheet& row) { return row.unit.kind == Kind::product; };
    return std::ranges::any_of (flat.node (r).type->outputs, isProduct);
}

bool isUnknown (const PortUnits::Found& f) { return f.quantity == Quantity::any && ! f.dimension; }

/// Looks for a port with a fixed unit that still determines what a generic port carries. Follows plain wires and "same as" rules.
class Anchor
{
public:
    Anchor (const Flat& f, const WireEnds& e, const PortUnits& u) : flat (f), ends (e), units (u) {}

    bool holds (const PortRef& start)
    {
        constexpr std::size_t most = 16;   // each port costs a search through all wires
        add (start);
        for (std::size_t i = 0; i < open.size() && i < most; ++i)
        {
            const auto port = open[i];
            if (isFixed (flat, port) && of (port).quantity != Quantity::any) return true;
            if (isInProduct (flat, port)) continue;
            followWires (port);
            followRules (port);
        }
        return false;
    }

private:
    const Flat& flat;
    const WireEnds& ends;
    const PortUnits& units;
    std::vector<PortRef> open;
    std::vector<int> seen;

    int numberOf (const PortRef& r) const { return units.number.in (flat, r); }
    const PortUnits::Found& of (const PortRef& r) const { return units.found[at (numberOf (r))]; }

    void add (const PortRef& r)
    {
        const int number = numberOf (r);
        if (std::ranges::count (seen, number) > 0) return;
        seen.push_back (number);
        open.push_back (r);
    }

    void followWires (const PortRef& port)
    {
        for (std::size_t i = 0; i < ends.ends.size(); ++i)
        {
            const auto [from, to] = ends.ends[i];
            if (from != port.node && to != port.node) continue;
            const auto& w = flat.wires[i];
            if (! w.from || w.gain_dimension) continue;
            if (from == port.node && numberOf (*w.from) == numberOf (port)) add (w.to);
            if (to == port.node && numberOf (w.to) == numberOf (port)) add (*w.from);
        }
    }

    void followRules (const PortRef& port)
    {
        const auto& n = flat.node (port);
        const auto named = [&] (std::string_view id) -> std::optional<PortRef> {
            for (const auto role : { Role::input, Role::param, Role::output })
                if (const auto row = std::ranges::find (n.ports (role), id, &PortSheet::id); row != n.ports (role).end())
                    return PortRef { port.node, role, static_cast<int> (row - n.ports (role).begin()), -1, -1 };
            return {};
        };
        for (const auto role : { Role::input, Role::param, Role::output })
            for (int p = 0; const auto& row : n.ports (role))
            {
                const PortRef here { port.node, role, p++, -1, -1 };
                if (row.unit.kind != Kind::same || row.unit.unit.dimension != Dimension {}) continue;
                const auto there = named (row.unit.a);
                if (! there) continue;
                if (numberOf (here) == numberOf (port)) add (*there);
                if (numberOf (*there) == numberOf (port)) add (here);
            }
    }
};
}   // namespace

bool fitsUnits (const Flat& flat, const PortUnits& units, const FlatWire& w)
{
    if (! w.from || w.gain_dimension || isInProduct (flat, *w.from) || isInProduct (flat, w.to)) return false;
    const auto &from = units.found[at (units.number.in (flat, *w.from))], &to = units.found[at (units.number.in (flat, w.to))];
    if (from.quantity != to.quantity || from.dimension != to.dimension) return false;
    return isUnknown (from) || from.quantity != Quantity::any || (isFixed (flat, *w.from) && isFixed (flat, w.to));
}

bool keepsUnits (const Flat& flat, const WireEnds& ends, const PortUnits& units, const FlatWire& w)
{
    if (! w.from) return true;
    if (isInProduct (flat, *w.from) || isInProduct (flat, w.to)) return false;
    const auto holds = [&] (const PortRef& r) {
        return isFixed (flat, r) || isUnknown (units.found[at (units.number.in (flat, r))]) || Anchor { flat, ends, units }.holds (r);
    };
    return holds (*w.from) && holds (w.to);
}

}   // namespace tactus::plan
