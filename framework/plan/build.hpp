// SPDX-License-Identifier: MIT
#pragma once

#include "lane_groups.hpp"
#include "plan.hpp"
#include "unit_check.hpp"

#include <tactus/node/node.hpp>

#include <memory>
#include <span>
#include <vector>

namespace tactus
{
struct CompileOptions;
}

namespace tactus::plan
{

/// Makes the nodes, lays out their outputs, and writes the records in the given order. The graph must be free of errors. It is
/// moved into the plan, except for its messages. Uses `before`, `withdrawn` and `kept` of the options.
/// The plan keeps the background, and fills in the rest of it.
std::shared_ptr<Plan> build (Flat&, const PortUnits&, const Order&, const LaneGroups&, Outside, const Setup&, const CompileOptions&,
                             std::shared_ptr<Background>);

/// The result of building the inputs of a single node again. The pointers point into the storage.
struct NodePart
{
    std::vector<Record> peeks, body;
    Instance instance;
    std::shared_ptr<void> storage;
};

/// Connects the first node of a small flat graph again. The other nodes are only there because wires start from them. The instances
/// are those of a plan that has all these nodes already, and `feeds` are the values of its feeds. Only for nodes that run in no section.
NodePart buildNode (Flat&, std::vector<std::vector<PortRef>> fed, std::span<const Instance>, std::span<double> feeds);

}   // namespace tactus::plan
