// SPDX-License-Identifier: MIT
#pragma once

#include "outside.hpp"
#include <tactus/plan/rules/order.hpp>

#include <cstddef>
#include <vector>

namespace tactus::plan
{

/// The nodes that run as lanes.
struct LaneGroups
{
    struct Group
    {
        std::vector<int> nodes;   ///< by number of the instance
        const LaneForm* form;
    };

    std::vector<Group> all;
    std::vector<int> of;   ///< by node: its group; -1 if it runs on its own. Empty if there are no groups

    const Group* find (int node) const noexcept { return of.empty() || of[at (node)] < 0 ? nullptr : &all[at (of[at (node)])]; }
};

/// Finds nodes that can run as lanes: the same node in each instance of a subgraph with a `count`. Its type must have lanes, and its params
/// must have no wires and no feeds. Changes the order so that the nodes of a group run one after another, as one step. Where
/// that would make a loop, because wires lead from instance to instance, the nodes run on their own. `widest`: the most lanes of a pack.
LaneGroups groupLanes (const Flat&, Order&, const Outside&, std::size_t widest, double rate_hz);

}   // namespace tactus::plan
