// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

namespace tactus::plan
{

/// Returns the section that the inside of a subgraph node runs in: a new one if the node has an `every` or `times` of 2 or more,
/// else `around`. Errors: rate/value, rate/both. `hold` without `every` is a warning (rate/hold_alone).
int openSection (const graph::Node&, int around, const std::string& path, Origin, Flat&);

/// Reports an error (rate/no_subgraph) if a node that is not a subgraph has `every`, `times` or `hold`. `prefix` comes before the name of
/// the node in its path.
void refuseSection (const graph::Node&, const std::string& prefix, Origin, Flat&);

/// Reports sections whose rate is out of range for nodes (rate/value), and `times` sections with a path to a sink that acts on
/// a hand (rate/to_the_hand).
void checkSections (Flat&, double rate_hz);

}   // namespace tactus::plan
