// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/flat/flat.hpp>

namespace tactus::plan
{

/// Numbers the ports of a flat graph: one number per port, or one per entry if each entry has its own unit.
class PortNumbers
{
public:
    PortNumbers() = default;
    explicit PortNumbers (const Flat&);

    int operator() (const PortRef& r) const noexcept { return in (*flat, r); }
    int in (const Flat&, const PortRef&) const noexcept;   ///< the same for another flat graph with the same nodes
    int firstOf (int node) const noexcept { return first[at (node)].input; }
    int count() const noexcept { return first.back().input; }

    static int entries (const FlatNode&, const PortSheet&) noexcept;

    const Flat* flat = nullptr;

private:
    /// The numbers of the first port of each role of a node.
    struct First
    {
        int input, param, output;
        bool is_plain;   // each port has one number

        int of (Role role) const noexcept
        {
            if (role == Role::input) return input;
            return role == Role::param ? param : output;
        }
    };

    std::vector<First> first;   // of each node; the input of the last one is the end
};

/// The unit of each port of a flat graph: from the datasheet, or inferred for generic nodes.
struct PortUnits
{
    /// The quantity and the dimension of a port: `any` and no dimension if nothing determines them.
    struct Found
    {
        Quantity quantity = Quantity::any;
        std::optional<Dimension> dimension {};
    };

    const Found& operator() (const PortRef& r) const { return found[at (number (r))]; }

    /// SI symbol; "" if unknown.
    std::string symbol (const PortRef&) const;

    PortNumbers number;
    std::vector<Found> found;
};

/// Checks every wire and every value with a unit, and infers what generic nodes carry. A wrong dimension is an error (wire/unit,
/// param/unit, node/unit). Another quantity of the same dimension is a warning (wire/quantity).
PortUnits checkUnits (Flat&);

}   // namespace tactus::plan
