// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

#include <framework/node.hpp>

namespace tactus::plan
{

/// Warns (rate/aliasing) of what does not fit where the rate falls: wires into `every` sections and out of `times`
/// sections, and nodes in `every` sections. Nodes tell by what their datasheets have in Hz, by their claims and by
/// their own warnings; generic nodes have what they get.
void warnOfAliasing (Flat&, const PortUnits&, const Setup&);

}   // namespace tactus::plan
