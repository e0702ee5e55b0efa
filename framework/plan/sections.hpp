// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

namespace tactus::plan
{

/// The section that the inside of a subgraph node runs in: one of its own, if the node has an `every` or `times` of 2 or
/// more, else `around`. What is wrong is reported: rate/value, rate/both; `hold` without `every` is a warning
/// (rate/hold_alone).
int openSection (const graph::Node&, int around, const std::string& path, Origin, Flat&);

/// Only subgraphs run at a rate of their own: on any other node that is an error (rate/no_subgraph).
void refuseSection (const graph::Node&, const std::string& path, Origin, Flat&);

/// Rates that no node is made for (rate/value), and `times` sections that lead to something that acts on a hand, port by
/// port (rate/to_the_hand).
void checkSections (Flat&, double rate_hz);

}   // namespace tactus::plan
