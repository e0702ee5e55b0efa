// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

namespace tactus::plan
{

/// Numbers the ports of a flat graph: one number a port, or one an entry where each entry has a unit of its own.
class PortNumbers
{
public:
    explicit PortNumbers (const Flat&);

    int operator() (const PortRef&) const noexcept;
    int firstOf (int node) const noexcept { return first[static_cast<std::size_t> (node)]; }
    int count() const noexcept { return first.back(); }

    static int entries (const FlatNode&, const PortSheet&) noexcept;

    const Flat* flat;

private:
    std::vector<int> first;   // of each node, and the end
};

/// The unit of each port of a flat graph: stated by the datasheet, or inferred for generic nodes.
struct PortUnits
{
    /// "any" and nothing where nothing says what a port carries.
    struct Found
    {
        Quantity quantity = Quantity::any;
        std::optional<Dimension> dimension {};
    };

    const Found& operator() (const PortRef& r) const { return found[static_cast<std::size_t> (number (r))]; }

    /// In SI; "" where nothing says.
    std::string symbol (const PortRef&) const;

    PortNumbers number;
    std::vector<Found> found;
};

/// Checks every wire and every value with a unit, and infers what generic nodes carry. A dimension that does not fit is
/// an error (wire/unit, param/unit, node/unit), another quantity of the same dimension a warning (wire/quantity).
PortUnits checkUnits (Flat&);

}   // namespace tactus::plan
