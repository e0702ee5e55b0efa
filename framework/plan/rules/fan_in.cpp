// SPDX-License-Identifier: MIT
#include "fan_in.hpp"
#include <tactus/plan/build/slots.hpp>

#include <tactus/graph/endpoint_text.hpp>

namespace tactus::plan
{

namespace
{
std::string inWords (Quantity q) { return q == Quantity::any ? "value" : std::string (name (q)); }

void reportInstances (Flat& flat, const FlatWire& w, const std::optional<PortRef>& other, Quantity quantity)
{
    flat.error ("wire/which_instance", w.origin,
                "\"" + toText (*w.written) + "\" starts from several instances, but a " + inWords (quantity) + " cannot be summed",
                other ? "name one instance, as in " + flat.nameOf (*other) : "name one instance");
}

void reportTwo (Flat& flat, const FlatWire& w, const FlatWire& other, Quantity quantity)
{
    flat.error ("wire/two_into_one", w.origin,
                "\"" + toText (*other.written) + "\" and \"" + toText (*w.written) + "\" both end at '" + flat.nameOf (w.to) + "', but a "
                    + inWords (quantity) + " cannot be summed",
                w.to.role == Role::param ? "add the second wire with (+), or remove one of the two"
                                         : "join the two wires in a signal.add or vector.add node, or remove one of them");
}

/// True if several values at a port are summed. Several wires into a generic input are summed if what they carry adds up.
bool sumsWires (const PortSheet& row, Quantity carried) noexcept
{
    if (row.role != Role::input) return false;
    return row.unit.adds_up || addsUp (row.unit.kind == UnitRule::Kind::fixed ? row.unit.unit.quantity : carried);
}
}   // namespace

void checkFanIn (Flat& flat, const PortUnits& units)
{
    const Slots slots (flat);
    std::vector<const FlatWire*> taken (slots.count(), nullptr);
    Identity wrong {};   // the wire reported last
    for (const auto& w : flat.wires)
    {
        if (w.identity == wrong || w.add) continue;
        const int first = w.to.component >= 0 ? w.to.component : 0;
        for (int c = first; c < first + flat.widthOf (w.to); ++c)
        {
            auto*& other = taken[slots (w.to, c)];
            if (other == nullptr)
            {
                other = &w;
                continue;
            }
            if (sumsWires (flat.sheet (w.to), units (w.to).quantity)) break;
            if (other->identity == w.identity)
            {
                const auto quantity = w.from ? units (*w.from).quantity : Quantity::any;
                if (addsUp (quantity)) continue;
                reportInstances (flat, w, other->from, quantity);
            }
            else
                reportTwo (flat, w, *other, units (w.to).quantity);
            wrong = w.identity;
            break;
        }
    }
}

}   // namespace tactus::plan
