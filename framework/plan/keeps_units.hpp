// SPDX-License-Identifier: MIT
#pragma once

#include "background.hpp"

namespace tactus::plan
{

/// True if a wire fits the units that were found without it, and neither adds to them nor warns. The wire must not be in the lists yet.
bool fitsUnits (const Flat&, const PortUnits&, const FlatWire&);

/// True if what all ports carry remains known without a wire. The wire must have been removed from the lists. Also false if
/// that would take too long to find out.
bool keepsUnits (const Flat&, const WireEnds&, const PortUnits&, const FlatWire& removed);

}   // namespace tactus::plan
