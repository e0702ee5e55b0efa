// SPDX-License-Identifier: MIT
#include "unit_check.hpp"
#include <tactus/plan/flat/grouped.hpp>
#include <tactus/plan/values.hpp>

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>
#include <utility>

namespace tactus::plan
{

namespace
{
/// Sets of ports joined by wires and `same as`. The dimension of each port is the dimension of its set times the port's own
/// factor.
class Joined
{
public:
    explicit Joined (int size) : parent (at (size)), factor (at (size)), known (at (size))
    {
        std::iota (parent.begin(), parent.end(), 0);
    }

    int root (int v)
    {
        int r = v;
        Dimension total;
        while (up (r) != r)
        {
            total = scaled (total, factor[at (r)]);
            r = up (r);
        }
        while (up (v) != r && v != r)   // shortens the path for later calls
        {
            const auto i = at (v);
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
        const auto& d = known[at (root (v))];
        if (! d) return {};
        return scaled (*d, factorOf (v));
    }

    /// Sets the dimension of v. Returns false if v is known to have a different one.
    bool state (int v, Dimension d)
    {
        const int r = root (v);
        const auto wanted = r == v ? d : d / factorOf (v);
        auto& k = known[at (r)];
        if (! k) k = wanted;
        return *k == wanted;
    }

    /// Sets dimension (b) = dimension (a) times `times`. Returns false if both are known and disagree.
    bool join (int a, int b, Dimension times)
    {
        const int ra = root (a), rb = root (b);
        const auto shift = ra == a && rb == b ? times : factorOf (a) * times / factorOf (b);   // factor of rb relative to ra
        if (ra == rb) return shift == Dimension {};
        auto& of_a = known[at (ra)];
        const auto& of_b = known[at (rb)];
        if (of_a && of_b && *of_b != scaled (*of_a, shift)) return false;
        if (! of_a && of_b) of_a = *of_b / shift;
        parent[at (rb)] = ra;
        factor[at (rb)] = shift;
        return true;
    }

private:
    std::vector<int> parent;
    std::vector<Dimension> factor;                 // relative to the parent
    std::vector<std::optional<Dimension>> known;   // by root

    /// A product. Most factors are 1.
    static Dimension scaled (Dimension d, Dimension by) { return by == Dimension {} ? d : d * by; }

    int up (int v) const { return parent[at (v)]; }
    Dimension factorOf (int v) const { return up (v) == v ? Dimension {} : factor[at (v)]; }   // call root (v) first
};

class UnitCheck
{
public:
    explicit UnitCheck (Flat& f)
        : flat (f), variable (f), dimensions (variable.count()), quantity (at (variable.count()), Quantity::any), generic (at (variable.count()), false)
    {
    }

    PortUnits run()
    {
        for (int n = 0; n < flat.nodeCount(); ++n)
            stateDatasheet (n);
        for (const auto& w : flat.wires)
            wire (w);
        for (const auto& a : flat.assignments)
            assignment (a);
        multiply();
        linkProducts();
        nameQuantities();
        return result();
    }

private:
    Flat& flat;
    PortNumbers variable;
    Joined dimensions;
    std::vector<Quantity> quantity;
    std::vector<bool> generic;   // by port: true if it takes its quantity from its wires

    /// Two ports that carry the same quantity: joined by a wire, by a generic node, or by a factor without a unit.
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
            const auto& rows = flat.node (node).ports (role);
            const auto row = std::ranges::find (rows, id, &PortSheet::id);
            if (row != rows.end()) return PortRef { node, role, static_cast<int> (row - rows.begin()), -1, -1 };
        }
        return {};
    }

    void stateDatasheet (int node)
    {
        const auto& n = flat.node (node);
        int next = variable.firstOf (node);
        for (const auto role : { Role::input, Role::param, Role::output })
            for (const auto& row : n.ports (role))
            {
                const int v = std::exchange (next, next + PortNumbers::entries (n, row));
                if (row.unit.kind != UnitRule::Kind::fixed)
                    std::fill_n (generic.begin() + v, PortNumbers::entries (n, row), true);
                if (row.unit.kind == UnitRule::Kind::fixed)
                {
                    dimensions.state (v, row.unit.unit.dimension);
                    quantity[at (v)] = row.unit.unit.quantity;
                }
                else if (row.unit.kind == UnitRule::Kind::same)
                {
                    if (const auto other = named (node, row.unit.a))
                    {
                        const int a = variable (*other);
                        dimensions.join (a, v, row.unit.unit.dimension);
                        if (row.unit.unit.dimension == Dimension {}) links.push_back ({ a, v, nullptr });
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
            flat.error ("wire/unit", w.origin,
                        "'" + flat.nameOf (*w.from) + "' carries " + symbolOf (arrives) + (w.gain_dimension ? " after the wire's gain" : "") + ", but '"
                            + flat.nameOf (w.to) + "' takes " + symbolOf (want.value_or (Dimension {})),
                        "wire a port with the right unit, or give the wire a gain " + (needed == Dimension {} ? "without a unit" : "in " + symbolOf (needed)));
            return;
        }
        if (gain == Dimension {}) links.push_back ({ from, to, &w });
    }

    void assignment (const Assignment& a)
    {
        const auto& sheet = flat.sheet (a.to);
        if (! sheet.choices.empty()) return;
        const auto all = [&] (const Json& json) {
            if (! json.is_array()) return fits (a, sheet, json);
            return std::ranges::all_of (json, [&] (const Json& part) { return fits (a, sheet, part); });
        };
        if (all (*a.low) && a.high != a.low) all (*a.high);
    }

    /// Returns false, with a message, if a number has a unit that does not fit the param.
    bool fits (const Assignment& a, const PortSheet& sheet, const Json& json)
    {
        if (! json.is_string()) return true;
        const auto number = readNumber (json);
        if (! number || ! number->dimension) return true;
        const int v = variable (a.to);
        if (! dimensions.state (v, *number->dimension))
        {
            const auto unit = symbolOf (*dimensions.dimension (v));
            flat.error ("param/unit", a.origin,
                        "'" + flat.nameOf (a.to) + (unit == "1" ? "' has no unit" : "' is in " + unit) + ", but " + shown (json) + " is in "
                            + symbolOf (*number->dimension),
                        unit == "1" ? "write the number without a unit" : "write the value in " + unit + ", or as a plain SI number");
            return false;
        }
        if (miscounts (*number, sheet.unit))
        {
            flat.error ("param/unit", a.origin, "'" + flat.nameOf (a.to) + "': " + miscount (json, sheet.unit),
                        "divide the value by 2 pi rad or 360 deg, and write the result in " + std::string (sheet.unit.unit.symbol));
            return false;
        }
        return true;
    }

    /// Products carry dimensions forward, and backward if a single factor is unknown. Each change may enable others, so passes
    /// repeat until one changes nothing. They alternate in direction, so a chain takes two passes, regardless of the order in
    /// which it was written.
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
                        const auto& n = flat.node (p.node);
                        flat.error ("node/unit", n.origin,
                                    "'" + n.path + "' has a product in " + symbolOf (known) + ", but its output is used in " + symbolOf (*out),
                                    "check what is wired into it");
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

    /// A product carries the quantity of its only factor that has a unit: a force times a ratio is a force.
    void linkProducts()
    {
        for (const auto& p : products)
        {
            const auto isRatio = [this] (int f) { return dimensions.dimension (f) == Dimension {}; };
            const auto only = std::ranges::find_if_not (p.factors, isRatio);
            if (only == p.factors.end() || ! dimensions.dimension (*only)) continue;
            if (std::all_of (std::next (only), p.factors.end(), isRatio)) links.push_back ({ *only, p.out, nullptr });
        }
    }

    /// Connected generic ports carry the one quantity that is wired to them. If there are several, the ports carry none, and
    /// each wire whose quantity differs from the first one (in the order of the enum) is a warning. A wire that joins two
    /// quantities directly is a warning too. None of this depends on the order of the wires.
    void nameQuantities()
    {
        const Grouped<int> neighbours (at (variable.count()), [this] (auto visit) {
            for (const auto& l : links)
            {
                visit (l.a, l.b);
                visit (l.b, l.a);
            }
        });

        std::vector<Quantity> expected (at (variable.count()), Quantity::any);
        std::vector<bool> seen = generic;
        seen.flip();
        std::vector<int> together;
        for (int start = 0; start < variable.count(); ++start)
        {
            if (seen[at (start)]) continue;
            seen[at (start)] = true;
            together = { start };
            unsigned found = 0;   // one bit per quantity, in the order of the enum
            for (std::size_t i = 0; i < together.size(); ++i)
                for (const int n : neighbours[at (together[i])])
                {
                    if (! generic[at (n)]) found |= 1u << static_cast<unsigned> (quantity[at (n)]);
                    if (seen[at (n)]) continue;
                    seen[at (n)] = true;
                    together.push_back (n);
                }
            found &= ~(1u << static_cast<unsigned> (Quantity::any));
            const auto first = found == 0 ? Quantity::any : static_cast<Quantity> (std::countr_zero (found));
            for (const int v : together)
            {
                expected[at (v)] = first;
                quantity[at (v)] = std::has_single_bit (found) ? first : Quantity::any;
            }
        }
        for (const auto& l : links)
            if (l.wire) compareQuantities (l, expected);
    }

    void compareQuantities (const Link& l, const std::vector<Quantity>& expected)
    {
        const auto of = [&] (int v) { return generic[at (v)] ? expected[at (v)] : quantity[at (v)]; };
        const auto a = of (l.a), b = of (l.b);
        if (a == Quantity::any || b == Quantity::any || a == b) return;
        const auto& w = *l.wire;
        flat.warn ("wire/quantity", w.origin,
                   "the quantity of '" + flat.nameOf (*w.from) + "' is " + std::string (name (a)) + ", that of '" + flat.nameOf (w.to) + "' is "
                       + std::string (name (b)) + "; both have the unit " + symbolOf (dimensions.dimension (l.a).value_or (Dimension {})),
                   "fine if intended; otherwise wire another port");
    }

    PortUnits result()
    {
        PortUnits units { variable, {} };
        units.found.reserve (at (variable.count()));
        for (int v = 0; v < variable.count(); ++v)
            units.found.push_back ({ quantity[at (v)], dimensions.dimension (v) });
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
        const int begin = next;
        int begins[3];
        for (int r = 0; const auto role : { Role::input, Role::param, Role::output })
        {
            begins[r++] = next;
            for (const auto& row : n.ports (role))
                next += entries (n, row);
        }
        const auto rows = n.type->inputs.size() + n.type->params.size() + n.type->outputs.size();
        first.push_back ({ begins[0], begins[1], begins[2], at (next - begin) == rows });
    }
    first.push_back ({ next, next, next, true });
}

int PortNumbers::entries (const FlatNode& n, const PortSheet& row) noexcept
{
    return row.list && row.unit.kind == UnitRule::Kind::each ? n.list_size : 1;
}

int PortNumbers::in (const Flat& other, const PortRef& r) const noexcept
{
    const auto& begin = first[at (r.node)];
    int number = begin.of (r.role);
    if (begin.is_plain) return number + r.port;
    const auto& n = other.node (r);
    const auto& rows = n.ports (r.role);
    for (int i = 0; i < r.port; ++i)
        number += entries (n, rows[at (i)]);
    return number + (entries (n, rows[at (r.port)]) > 1 ? std::max (r.index, 0) : 0);
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
