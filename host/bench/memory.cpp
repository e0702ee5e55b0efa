// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory.hpp"
#include "one_poles.hpp"

#include <tactus/nodes/filter/one_pole.hpp>

#include <malloc.h>

namespace tactus::bench
{

namespace
{
double inUse()
{
    const auto info = mallinfo2();
    return static_cast<double> (info.uordblks + info.hblkhd);
}
}   // namespace

Memory memoryPerNode()
{
    constexpr int n = 10000;
    const auto g = chainOfOnePoles (n);
    std::vector<std::shared_ptr<void>> nodes;
    nodes.reserve (n);

    const double before = inUse();
    const auto plan = compile (g, catalogue()).plan;
    const double whole = inUse();
    for (const auto& instance : plan->instances())
        nodes.push_back (instance.node);   // keeps the nodes alive
    plan->forgetGraph();
    const double ticked = inUse();
    return { .to_tick = (ticked - before) / n - sizeof (nodes::OnePole), .to_edit = (whole - ticked) / n };
}

}   // namespace tactus::bench
