// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

namespace tactus::plan
{

/// Which node, and which wire that is delayed or leads from one rate to another, of the graph before each of a graph is:
/// its number there, or -1.
struct Heirs
{
    std::vector<int> nodes, wires;
};

/// By the ids of the subgraph nodes around them, which instances of these, and their own. Copies go by what they were made
/// from. Of what is around only that counts which is on both sides, so that to collapse or expand changes nothing; and
/// what still has no like, but occurs only once here and there, has been moved. The wires that one wire stands for
/// between instances are told apart by the nodes at their ends.
Heirs findHeirs (const Flat& now, const Flat& before);

}   // namespace tactus::plan
