// SPDX-License-Identifier: MIT
#pragma once

#include "plan.hpp"
#include "unit_check.hpp"

#include <framework/node.hpp>

namespace tactus::plan
{

/// What is driven and read from outside the graph, resolved. A placeholder's port is nothing: driven in vain, read as 0.
struct Outside
{
    /// A port or a part of it, under the name that was asked for.
    struct Read
    {
        std::string name;
        std::optional<PortRef> port;
    };

    std::vector<std::vector<PortRef>> feeds;   ///< one component each, perhaps in several instances
    std::vector<Read> records;
};

/// A node with its params and settings in place, not yet prepared; null for a bypassed subgraph.
std::shared_ptr<void> makeNode (const Flat&, int number);

/// Makes the nodes, lays out their outputs, and writes the records in the given order. For a graph without errors, which
/// goes over into the plan. The plan before is null, or the one this is to take over from; likewise the withdrawn one
/// (CompileOptions).
std::shared_ptr<Plan> build (Flat&, const PortUnits&, const Order&, const Outside&, const Setup&, const Plan* before, const Plan* withdrawn);

}   // namespace tactus::plan
