// SPDX-License-Identifier: MIT
#pragma once

#include "plan.hpp"
#include "unit_check.hpp"

#include <framework/node.hpp>

#include <span>

namespace tactus::plan
{

/// What is driven and read from outside the graph, resolved.
struct Outside
{
    std::vector<PortRef> feeds;     ///< one component each
    std::vector<PortRef> records;   ///< whole ports or parts of them
};

/// Makes the nodes, lays out their outputs, and writes the records in the given order. Problems that only a made node
/// can tell (a setting it cannot work with) are added to the flat graph's messages.
std::shared_ptr<Plan> build (Flat&, const PortUnits&, std::span<const int> order, const Outside&, const Setup&);

}   // namespace tactus::plan
