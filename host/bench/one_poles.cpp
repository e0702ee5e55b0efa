// SPDX-License-Identifier: GPL-3.0-or-later
#include "one_poles.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/kit/random.hpp>

#include <algorithm>

namespace tactus::bench
{

namespace
{
std::string nameOf (int pole) { return "p" + std::to_string (pole); }

graph::Graph onePoles (int n, int (*feederOf) (int pole))
{
    graph::Graph g;
    for (int i = 0; i < n; ++i)
    {
        graph::Node node;
        node.name = nameOf (i);
        node.type = "filter.one_pole";
        node.params["cutoff"] = cutoffOf (i);
        g.root.nodes.push_back (std::move (node));
        if (i > 0) g.root.wires.push_back (*graph::parseWire (nameOf (feederOf (i)) + ".out -> " + nameOf (i) + ".in"));
    }
    return g;
}
}   // namespace

double cutoffOf (int pole) { return 200.0 + 10.0 * (pole % 100); }

graph::Graph chainOfOnePoles (int n)
{
    return onePoles (n, [] (int pole) { return pole - 1; });
}

graph::Graph treeOfOnePoles (int n)
{
    return onePoles (n, [] (int pole) { return (pole - 1) / 2; });
}

graph::Graph shuffled (graph::Graph g)
{
    Random random { 1 };
    auto& nodes = g.root.nodes;
    for (std::size_t i = nodes.size(); i > 1; --i)
        std::swap (nodes[i - 1], nodes[random.bits() % i]);
    return g;
}

CompileOptions endsOf (const graph::Graph& g)
{
    CompileOptions options { .feeds = { "p0.in" } };
    for (const auto& node : g.root.nodes)
        if (std::ranges::none_of (g.root.wires, [&] (const graph::Wire& w) { return w.from.node == node.name; }))
            options.records.push_back (node.name + ".out");
    return options;
}

}   // namespace tactus::bench
