// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/plan/plan.hpp>

#include <string>

namespace tactus::host
{

/// The node that takes longest, with its share: "'bar' (vibration.modal) takes 83 % of a tick". Ticks the plan to find
/// out, so that a run must be over; nothing reaches a device. [main thread]
std::string costliestNode (Plan&);

}   // namespace tactus::host
