// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

#include <algorithm>

namespace tactus::plan
{

/// The kind of signal that a wire carries. It decides how values are converted from one rate to another.
enum class SignalKind
{
    signal,   ///< can be interpolated
    steps,    ///< a state or a count: cannot be interpolated
    hits      ///< each hit lasts one tick, and must arrive on exactly one tick of the other rate
};

/// The quantities at both ends of a wire decide: a hit remains a hit even if a generic node receives it.
inline SignalKind carriedBy (const Flat& flat, const PortUnits& units, const PortRef& port)
{
    const auto quantity = units (port).quantity;
    const auto& rule = flat.sheet (port).unit;
    if (quantity == Quantity::hit) return SignalKind::hits;
    const bool counts = port.role == Role::output && rule.kind == UnitRule::Kind::fixed && rule.unit == unit::count && flat.sheet (port).width == 1;
    return quantity == Quantity::state || counts ? SignalKind::steps : SignalKind::signal;
}

inline SignalKind carriedBy (const Flat& flat, const PortUnits& units, const FlatWire& w)
{
    const auto to = carriedBy (flat, units, w.to);
    return w.from ? std::max (to, carriedBy (flat, units, *w.from)) : to;
}

}   // namespace tactus::plan
