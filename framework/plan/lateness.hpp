// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

namespace tactus::plan
{

/// Warns (rate/late) of all that holds back what returns to the hand: delayed wires, delaying nodes, and sections whose
/// outputs go in straight lines, wherever they stand on a way from a device's source to a sink. Loops are left alone:
/// they cannot be without. `node_delays` as for pathDelays.
void warnOfDelays (Flat&, const PortUnits&, const std::vector<int>& node_delays);

}   // namespace tactus::plan
