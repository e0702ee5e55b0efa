// SPDX-License-Identifier: MIT
#pragma once

#include "outside.hpp"
#include <tactus/plan/plan.hpp>
#include <tactus/plan/rules/unit_check.hpp>

#include <tactus/node/node.hpp>

#include <memory>
#include <vector>

namespace tactus
{
struct CompileOptions;
}

namespace tactus::plan
{

/// Makes the nodes, lays out their outputs, and writes the records in the given order. The graph must be free of errors. It is
/// moved into the plan, except for its messages. Uses `before`, `withdrawn` and `kept` of the options.
std::shared_ptr<Plan> build (Flat&, const PortUnits&, const Order&, Outside, const Setup&, const CompileOptions&);

}   // namespace tactus::plan
