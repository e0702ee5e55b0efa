// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

#include <tactus/node/node.hpp>

namespace tactus::plan
{

/// Warns (rate/aliasing) where the rate is too low for a signal: on wires into `every` sections and out of `times`
/// sections, and for nodes in `every` sections. The frequency content of a signal comes from the node that generates it: its
/// datasheet rows in Hz, its claims and its warnings. A generic node passes on the frequency content of its inputs.
void warnOfAliasing (Flat&, const PortUnits&, const Setup&);

}   // namespace tactus::plan
