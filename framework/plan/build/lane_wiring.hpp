// SPDX-License-Identifier: MIT
#pragma once

#include "lane_groups.hpp"
#include "slots.hpp"
#include "storage.hpp"

namespace tactus::plan
{

/// Makes the groups of a plan, whose nodes must be prepared, or shares those of the plan before it. Without one, the groups are ready to tick;
/// otherwise Takeover makes them ready. `before` may be null.
void makeLaneGroups (const LaneGroups&, const Flat&, const PlanParts* before, PlanParts&);

/// Connects a group to the sources of its nodes, which must be in place, and to the outputs of the first one.
void connect (LaneStep&, const LaneGroups::Group&, const Flat&, const Slots&, const Storage&, void* outputs);

}   // namespace tactus::plan
