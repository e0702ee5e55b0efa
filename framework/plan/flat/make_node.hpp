// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

#include <memory>

namespace tactus::plan
{

/// Makes a node with its params and settings, but does not prepare it. Returns null for a bypassed subgraph.
std::shared_ptr<void> makeNode (const Flat&, int number);

}   // namespace tactus::plan
