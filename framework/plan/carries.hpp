// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

#include <algorithm>

namespace tactus::plan
{

/// How a wire's values pass from one rate to another.
enum class Carries
{
    signal,   ///< has values in between
    steps,    ///< a state or a count: has none
    hits      ///< each is there on one tick, and arrives on one
};

/// By the quantity at either end: what is a hit at one is none the less one where a generic node takes it.
inline Carries carriedBy (const Flat& flat, const PortUnits& units, const PortRef& port)
{
    const auto quantity = units (port).quantity;
    const auto& rule = flat.sheet (port).unit;
    if (quantity == Quantity::hit) return Carries::hits;
    const bool counts = port.role == Role::output && rule.kind == UnitRule::Kind::fixed && rule.unit == unit::count && flat.sheet (port).width == 1;
    return quantity == Quantity::state || counts ? Carries::steps : Carries::signal;
}

inline Carries carriedBy (const Flat& flat, const PortUnits& units, const FlatWire& w)
{
    const auto to = carriedBy (flat, units, w.to);
    return w.from ? std::max (to, carriedBy (flat, units, *w.from)) : to;
}

}   // namespace tactus::plan
