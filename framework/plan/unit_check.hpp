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

    int operator() (const PortRef&) const;
    int count() const noexcept { return total; }

    static int entries (const FlatNode&, const PortSheet&) noexcept;

private:
    const Flat* flat;
    std::vector<int> first;   // of each node
    int total = 0;
};

/// The unit of each port of a flat graph: stated by the datasheet, or inferred for generic nodes.
struct PortUnits
{
    /// The quantity and SI symbol of a port; "any" and "" where nothing says what it carries.
    struct Found
    {
        Quantity quantity = Quantity::any;
        std::optional<Dimension> dimension;
        std::string symbol;
    };

    const Found& operator() (const PortRef& r) const { return found[static_cast<std::size_t> (number (r))]; }

    PortNumbers number;
    std::vector<Found> found;
};

/// Checks every wire and every value with a unit, and infers what generic nodes carry. A dimension that does not fit is
/// an error (wire/unit, param/unit, node/unit), another quantity of the same dimension a warning (wire/quantity).
PortUnits checkUnits (Flat&);

}   // namespace tactus::plan
