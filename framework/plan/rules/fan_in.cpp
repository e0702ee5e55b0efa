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
}   // namespace

std::optional<bool> sumsWires (const PortSheet& row) noexcept
{
    if (row.role != Role::input) return false;
    if (row.unit.adds_up) return true;
    if (row.unit.kind != UnitRule::Kind::fixed) return std::nullopt;
    return addsUp (row.unit.unit.quantity);
}

bool checkFanIn (Flat& flat, const PortUnits& units)
{
    const Slots slots (flat);
    std::vector<const FlatWire*> taken (slots.count(), nullptr);
    Identity wrong {};   // the wire reported last
    bool wires_decide = false;
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
            const auto sums = sumsWires (flat.sheet (w.to));
            wires_decide = wires_decide || ! sums;
            if (sums.value_or (addsUp (units (w.to).quantity))) break;
            if (other->identity == w.identity)
            {
                const auto quantity = w.from ? units (*w.from).quantity : Quantity::any;
                wires_decide = true;
                if (addsUp (quantity)) continue;
                reportInstances (flat, w, other->from, quantity);
            }
            else
                reportTwo (flat, w, *other, units (w.to).quantity);
            wrong = w.identity;
            break;
        }
    }
    return wires_decide;
}

}   // namespace tactus::plan
