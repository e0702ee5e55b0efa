// SPDX-License-Identifier: MIT
#include "unit_check.hpp"
#include "grouped.hpp"
#include "values.hpp"

#include <bit>
#include <numeric>
#include <utility>

namespace tactus::plan
{

namespace
{
/// Sets of ports joined by wires and `same as`. Each port carries its set's dimension times a factor of its own.
class Joined
{
public:
    explicit Joined (int size) : parent (static_cast<std::size_t> (size)), factor (static_cast<std::size_t> (size)), known (static_cast<std::size_t> (size))
    {
        std::iota (parent.begin(), parent.end(), 0);
    }

    int root (int v)
    {
        int r = v;
        Dimension total;
        while (up (r) != r)
        {
            total = total * factor[static_cast<std::size_t> (r)];
            r = up (r);
        }
        while (up (v) != r && v != r)   // shorten the path for the next time
        {
            const auto i = static_cast<std::size_t> (v);
            const int next = parent[i];
            const auto rest = total / factor[i];
            parent[i] = r;
            factor[i] = total;
            total = rest;
            v = next;
        }
        return r;
    }

    std::optional<Dimension> dimension (int v)
    {
        const auto& d = known[static_cast<std::size_t> (root (v))];
        if (! d) return {};
        return *d * factorOf (v);
    }

    /// True, or false if v is known to carry another dimension.
    bool state (int v, Dimension d)
    {
        auto& k = known[static_cast<std::size_t> (root (v))];
        if (! k) k = d / factorOf (v);
        return *k == d / factorOf (v);
    }

    /// States dimension (b) = dimension (a) times `times`. False if both are known and disagree.
    bool join (int a, int b, Dimension times)
    {
        const int ra = root (a), rb = root (b);
        const auto shift = factorOf (a) * times / factorOf (b);   // of rb's set over ra's
        if (ra == rb) return shift == Dimension {};
        auto& of_a = known[static_cast<std::size_t> (ra)];
        const auto& of_b = known[static_cast<std::size_t> (rb)];
        if (of_a && of_b && *of_b != *of_a * shift) return false;
        if (! of_a && of_b) of_a = *of_b / shift;
        parent[static_cast<std::size_t> (rb)] = ra;
        factor[static_cast<std::size_t> (rb)] = shift;
        return true;
    }

private:
    std::vector<int> parent;
    std::vector<Dimension> factor;                 // to the parent
    std::vector<std::optional<Dimension>> known;   // of roots

    int up (int v) const { return parent[static_cast<std::size_t> (v)]; }
    Dimension factorOf (int v) const { return up (v) == v ? Dimension {} : factor[static_cast<std::size_t> (v)]; }   // after root (v)
};

class UnitCheck
{
public:
    explicit UnitCheck (Flat& f) : flat (f), variable (f), dimensions (variable.count()), quantity (static_cast<std::size_t> (variable.count()), Quantity::any), generic (static_cast<std::size_t> (variable.count()), false) {}

    PortUnits run()
    {
        for (int n = 0; n < static_cast<int> (flat.nodes.size()); ++n)
            stateDatasheet (n);
        for (const auto& w : flat.wires)
            wire (w);
        for (const auto& a : flat.assignments)
            assignment (a);
        multiply();
        nameQuantities();
        return result();
    }

private:
    Flat& flat;
    PortNumbers variable;
    Joined dimensions;
    std::vector<Quantity> quantity;
    std::vector<bool> generic;   // takes its quantity from what is wired

    /// Two ports that carry the same quantity: joined by a wire, or by a generic node.
    struct Link
    {
        int a, b;
        const FlatWire* wire;
    };
    std::vector<Link> links;

    struct Product
    {
        int node, out;
        std::vector<int> factors;
    };
    std::vector<Product> products;

    std::optional<PortRef> named (int node, std::string_view id) const
    {
        for (const auto role : { Role::input, Role::param, Role::output })
        {
            const auto& rows = flat.nodes[static_cast<std::size_t> (node)].ports (role);
            const auto row = std::ranges::find (rows, id, &PortSheet::id);
            if (row != rows.end()) return PortRef { node, role, static_cast<int> (row - rows.begin()), -1, -1 };
        }
        return {};
    }

    void stateDatasheet (int node)
    {
        const auto& n = flat.nodes[static_cast<std::size_t> (node)];
        int next = variable.firstOf (node);
        for (const auto role : { Role::input, Role::param, Role::output })
            for (const auto& row : n.ports (role))
            {
                const int v = std::exchange (next, next + PortNumbers::entries (n, row));
                if (row.unit.kind != UnitRule::Kind::fixed && row.unit.kind != UnitRule::Kind::product)
                    std::fill_n (generic.begin() + v, PortNumbers::entries (n, row), true);
                if (row.unit.kind == UnitRule::Kind::fixed)
                {
                    dimensions.state (v, row.unit.unit.dimension);
                    quantity[static_cast<std::size_t> (v)] = row.unit.unit.quantity;
                }
                else if (row.unit.kind == UnitRule::Kind::same)
                {
                    if (const auto a = named (node, row.unit.a))
                    {
                        dimensions.join (variable (*a), v, row.unit.unit.dimension);
                        if (row.unit.unit.dimension == Dimension {}) links.push_back ({ variable (*a), v, nullptr });
                    }
                }
                else if (row.unit.kind == UnitRule::Kind::product)
                {
                    Product p { node, v, {} };
                    for (const auto id : { row.unit.a, row.unit.b })
                        if (const auto a = named (node, id))
                            for (int k = 0; k < PortNumbers::entries (n, flat.sheet (*a)); ++k)
                                p.factors.push_back (variable (*a) + k);
                    products.push_back (std::move (p));
                }
            }
    }

    void wire (const FlatWire& w)
    {
        if (! w.from) return;
        const int from = variable (*w.from), to = variable (w.to);
        const auto gain = w.gain_dimension.value_or (Dimension {});
        if (! dimensions.join (from, to, gain))
        {
            const auto have = dimensions.dimension (from), want = dimensions.dimension (to);
            const auto arrives = have.value_or (Dimension {}) * gain;
            const auto needed = want.value_or (Dimension {}) / have.value_or (Dimension {});
            flat.error ("wire/unit", w.origin, "'" + flat.nameOf (*w.from) + "' carries " + symbolOf (arrives) + (w.gain_dimension ? " after the wire's gain" : "") + ", but '" + flat.nameOf (w.to) + "' takes " + symbolOf (want.value_or (Dimension {})),
                        "wire something that fits, or give the wire a gain in " + symbolOf (needed));
            return;
        }
        if (gain == Dimension {}) links.push_back ({ from, to, &w });
    }

    void assignment (const Assignment& a)
    {
        const auto& sheet = flat.sheet (a.to);
        if (! sheet.choices.empty()) return;
        const auto all = [&] (const Json& json)
        { return json.is_array() ? std::ranges::all_of (json, [&] (const Json& part)
                                                        { return fits (a, sheet, part); })
                                 : fits (a, sheet, json); };
        if (all (*a.low) && a.high != a.low) all (*a.high);
    }

    /// False, with a message, if a number has a unit that is not the param's.
    bool fits (const Assignment& a, const PortSheet& sheet, const Json& json)
    {
        if (! json.is_string()) return true;
        const auto read = readNumber (json);
        const auto* number = std::get_if<Number> (&read);
        if (number == nullptr || ! number->dimension) return true;
        const int v = variable (a.to);
        if (! dimensions.state (v, *number->dimension))
        {
            flat.error ("param/unit", a.origin, "'" + flat.nameOf (a.to) + "' is in " + symbolOf (*dimensions.dimension (v)) + ", but " + shown (json) + " is in " + symbolOf (*number->dimension),
                        "give it in " + symbolOf (*dimensions.dimension (v)) + ", or as a plain SI number");
            return false;
        }
        if (miscounts (*number, sheet.unit))
        {
            flat.error ("param/unit", a.origin, "'" + flat.nameOf (a.to) + "': " + miscount (json, sheet.unit), "divide by that, and give it in " + std::string (sheet.unit.unit.symbol));
            return false;
        }
        return true;
    }

    /// Products carry dimensions forward, and backward where a single factor is unknown. Each pass that changes
    /// something may let others go on; a pass without change ends it. Passes alternate in direction, so that a chain is
    /// done in two, whichever way round it was written.
    void multiply()
    {
        std::vector<bool> done (products.size(), false);
        bool forwards = false;
        for (bool changed = true; changed;)
        {
            changed = false;
            forwards = ! forwards;
            for (std::size_t k = 0; k < products.size(); ++k)
            {
                const auto i = forwards ? k : products.size() - 1 - k;
                if (done[i]) continue;
                const auto& p = products[i];
                Dimension known;
                int unknown = -1, unknowns = 0;
                for (const int f : p.factors)
                {
                    if (const auto d = dimensions.dimension (f))
                        known = known * *d;
                    else
                    {
                        unknown = f;
                        ++unknowns;
                    }
                }
                const auto out = dimensions.dimension (p.out);
                if (unknowns == 0)
                {
                    if (! dimensions.state (p.out, known))
                    {
                        const auto& n = flat.nodes[static_cast<std::size_t> (p.node)];
                        flat.error ("node/unit", n.origin, "'" + n.path + "' multiplies to " + symbolOf (known) + ", but its output is used as " + symbolOf (*out), "check what is wired into it");
                    }
                    done[i] = changed = true;
                }
                else if (unknowns == 1 && out)
                {
                    dimensions.state (unknown, *out / known);
                    done[i] = changed = true;
                }
            }
        }
    }

    /// Generic ports that hang together carry the one quantity that is wired to them. If there are several, they carry
    /// none, and each wire that brings another than the first (in the order of the enum) is a warning, as is a wire that
    /// joins two by itself. Nothing here depends on the order of the wires.
    void nameQuantities()
    {
        const Grouped<int> neighbours (static_cast<std::size_t> (variable.count()), [this] (auto visit)
                                       {
                                           for (const auto& l : links)
                                           {
                                               visit (l.a, l.b);
                                               visit (l.b, l.a);
                                           } });

        std::vector<Quantity> expected (static_cast<std::size_t> (variable.count()), Quantity::any);
        std::vector<bool> seen = generic;
        seen.flip();
        std::vector<int> together;
        for (int start = 0; start < variable.count(); ++start)
        {
            if (seen[static_cast<std::size_t> (start)]) continue;
            seen[static_cast<std::size_t> (start)] = true;
            together = { start };
            unsigned found = 0;   // a bit each, in the order of the enum
            for (std::size_t i = 0; i < together.size(); ++i)
                for (const int n : neighbours[static_cast<std::size_t> (together[i])])
                {
                    if (! generic[static_cast<std::size_t> (n)]) found |= 1u << static_cast<unsigned> (quantity[static_cast<std::size_t> (n)]);
                    if (seen[static_cast<std::size_t> (n)]) continue;
                    seen[static_cast<std::size_t> (n)] = true;
                    together.push_back (n);
                }
            found &= ~(1u << static_cast<unsigned> (Quantity::any));
            const auto first = found == 0 ? Quantity::any : static_cast<Quantity> (std::countr_zero (found));
            for (const int v : together)
            {
                expected[static_cast<std::size_t> (v)] = first;
                quantity[static_cast<std::size_t> (v)] = std::has_single_bit (found) ? first : Quantity::any;
            }
        }
        for (const auto& l : links)
            if (l.wire) compareQuantities (l, expected);
    }

    void compareQuantities (const Link& l, const std::vector<Quantity>& expected)
    {
        const auto of = [&] (int v)
        { return generic[static_cast<std::size_t> (v)] ? expected[static_cast<std::size_t> (v)] : quantity[static_cast<std::size_t> (v)]; };
        const auto a = of (l.a), b = of (l.b);
        if (a == Quantity::any || b == Quantity::any || a == b) return;
        const auto& w = *l.wire;
        flat.warn ("wire/quantity", w.origin, "'" + flat.nameOf (*w.from) + "' carries a " + std::string (name (a)) + " and '" + flat.nameOf (w.to) + "' a " + std::string (name (b)) + "; both are in " + symbolOf (dimensions.dimension (l.a).value_or (Dimension {})),
                   "fine if it is meant; else wire another port");
    }

    PortUnits result()
    {
        PortUnits units { variable, {} };
        units.found.reserve (static_cast<std::size_t> (variable.count()));
        for (int v = 0; v < variable.count(); ++v)
            units.found.push_back ({ quantity[static_cast<std::size_t> (v)], dimensions.dimension (v) });
        return units;
    }
};
}   // namespace

PortNumbers::PortNumbers (const Flat& f) : flat (&f)
{
    first.reserve (f.nodes.size() + 1);
    int next = 0;
    for (const auto& n : f.nodes)
    {
        first.push_back (next);
        for (const auto role : { Role::input, Role::param, Role::output })
            for (const auto& row : n.ports (role))
                next += entries (n, row);
    }
    first.push_back (next);
}

int PortNumbers::entries (const FlatNode& n, const PortSheet& row) noexcept
{
    return row.list && row.unit.kind == UnitRule::Kind::each ? n.list_size : 1;
}

int PortNumbers::operator() (const PortRef& r) const noexcept
{
    const auto& n = flat->node (r);
    const auto [inputs, params, outputs] = std::tuple { static_cast<int> (n.type->inputs.size()), static_cast<int> (n.type->params.size()), static_cast<int> (n.type->outputs.size()) };
    int number = firstOf (r.node);
    if (firstOf (r.node + 1) - number == inputs + params + outputs)   // one a row
        return number + r.port + (r.role == Role::input ? 0 : r.role == Role::param ? inputs
                                                                                    : inputs + params);
    for (const auto role : { Role::input, Role::param, Role::output })
        for (int i = 0; const auto& row : n.ports (role))
        {
            const int size = entries (n, row);
            if (role == r.role && i == r.port) return number + (size > 1 ? std::max (r.index, 0) : 0);
            number += size;
            ++i;
        }
    return number;
}

std::string PortUnits::symbol (const PortRef& r) const
{
    const auto& row = number.flat->sheet (r);
    if (row.unit.kind == UnitRule::Kind::fixed) return std::string (row.unit.unit.symbol);
    const auto& dimension = (*this) (r).dimension;
    return dimension ? symbolOf (*dimension) : "";
}

PortUnits checkUnits (Flat& flat) { return UnitCheck { flat }.run(); }

}   // namespace tactus::plan
