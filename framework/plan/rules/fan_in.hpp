// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

namespace tactus::plan
{

/// True if several values of this quantity at one port are summed.
constexpr bool addsUp (Quantity q) noexcept { return q == Quantity::force || q == Quantity::torque || q == Quantity::hit; }

/// Two wires into one port that does not sum are an error that names both. The same applies to one wire that starts from several
/// instances, even into ports that take only one wire, unless what it carries adds up.
void checkFanIn (Flat&, const PortUnits&);

}   // namespace tactus::plan
