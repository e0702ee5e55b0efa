// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

#include <optional>

namespace tactus::plan
{

/// True if several values of this quantity at one port are summed.
constexpr bool addsUp (Quantity q) noexcept { return q == Quantity::force || q == Quantity::torque || q == Quantity::hit; }

/// True if several wires may end at this port: they are summed at an input whose quantity adds up, and at one that takes sums of any unit. Empty if
/// the wires decide, because the input is generic.
std::optional<bool> sumsWires (const PortSheet&) noexcept;

/// Two wires into one port that does not sum are an error that names both. The same applies to one wire that starts from several
/// instances, even into ports that take only one wire, unless what it carries adds up. Returns true if wires decide anywhere: if a sum is
/// only right because of what a generic port carries.
bool checkFanIn (Flat&, const PortUnits&);

}   // namespace tactus::plan
