// SPDX-License-Identifier: MIT
#pragma once

#include "unit_check.hpp"

namespace tactus::plan
{

/// Warns (rate/late) about everything that delays the response to the hand: delayed wires, delaying nodes, and sections with
/// linear outputs, anywhere on a path from a device's source to a sink. Does not warn about delays in loops, which need them.
/// `node_delays` is the same as for pathDelays.
void warnOfDelays (Flat&, const PortUnits&, const std::vector<int>& node_delays);

}   // namespace tactus::plan
