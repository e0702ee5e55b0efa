// SPDX-License-Identifier: MIT
#pragma once

#include "plan_names.hpp"

namespace tactus::host
{

/// The memory that the nodes of an exported graph need.
struct NodeMemory
{
    std::size_t nodes = 0;      ///< bytes of the nodes themselves
    std::size_t prepared = 0;   ///< bytes that they take when they are made and prepared, with some room to spare
};

/// Makes and prepares all nodes once more, as exported code does, and counts. [main thread]
NodeMemory memoryOf (const PlanNames&);

}   // namespace tactus::host
