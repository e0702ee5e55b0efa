// SPDX-License-Identifier: MIT
#include "examine.hpp"
#include "aliasing.hpp"
#include "fan_in.hpp"
#include <tactus/plan/flat/device_of.hpp>
#include <tactus/plan/flat/make_node.hpp>
#include <tactus/plan/flat/sections.hpp>

#include <iterator>
#include <utility>

namespace tactus::plan
{

namespace
{
/// Delayed wires take memory, and even a short file can request more than the machine has.
void checkDelays (Flat& flat)
{
    for (const auto& w : flat.wires)
        if (w.delay > 0 && ! flat.spend (0.0, sizeof (double) * static_cast<double> (w.delay) * flat.widthOf (w.to), w.origin)) return;
}

/// Memory of a node in a plan, apart from what it prepares; measured.
double bytesOf (const FlatNode& n)
{
    constexpr double bytes_per_node = 500.0, bytes_per_number = 90.0;
    int numbers = 0;
    for (const auto* rows : { &n.type->inputs, &n.type->params })
        for (const auto& row : *rows)
            numbers += n.slots (row);
    return bytes_per_node + bytes_per_number * numbers;
}

/// Asks each node what it costs, whether its settings are usable, and whether it has a warning at its rate.
void askNodes (Flat& flat, const Setup& setup, const graph::Graph& graph)
{
    for (int i = 0; i < flat.nodeCount(); ++i)
    {
        const auto& n = flat.node (i);
        if (! flat.spend (0.0, bytesOf (n), n.origin)) return;
        if (n.runs()) warnOfDeviceDelay (flat, n, graph);
        if (! n.type->problem && ! n.type->warning && ! n.type->cost) continue;
        auto own = setup;
        own.rate_hz *= flat.speed (n.section);
        const std::string id (n.type->info.id), remedy = "`tactus nodes " + id + "` lists its params and settings, with their ranges";
        const auto node = makeNode (flat, i);
        if (n.type->learn && node) n.type->learn (node.get(), describedDevice (graph, n.role));
        const auto cost = n.type->cost && node ? n.type->cost (node.get()) : Cost {};
        if (! flat.spend (cost.work, cost.memory, n.origin)) return;
        const auto problem = n.type->problem && n.is_whole ? n.type->problem (node.get()) : std::string {};
        if (! problem.empty())
            flat.error ("node/problem", n.origin, "'" + n.path + "' (" + id + "): " + problem, remedy);
        else if (n.type->warning && n.is_whole)
            if (const auto warning = n.type->warning (node.get(), own); ! warning.empty())
                flat.warn ("node/warning", n.origin, "'" + n.path + "' (" + id + "): " + warning, remedy);
    }
}

/// The cost of compiling so far, including this flat graph.
Spent spentOn (const Flat& flat)
{
    auto spent = flat.spent;
    spent.nodes += static_cast<double> (flat.nodes.size() + flat.scopes.size());
    spent.wires += static_cast<double> (std::max (flat.wires.size(), flat.assignments.size()));
    return spent;
}

/// All checks of a flat graph that do not involve feeds and records.
void check (Flat& flat, const Setup& setup, const graph::Graph& graph, Examined& found)
{
    found.units = checkUnits (flat);
    checkFanIn (flat, found.units);
    checkDelays (flat);
    findDevices (flat);
    askNodes (flat, setup, graph);
    found.order = order (flat);
    checkSections (flat, setup.rate_hz);
    warnOfAliasing (flat, found.units, setup);
}
}   // namespace

Examined examine (const graph::Graph& g, const Catalogue& catalogue, const Setup& setup, std::span<const Override> overrides, Assets* assets,
                  SettingFiles files)
{
    Examined found { .flattened = flatten (g, catalogue, overrides, assets, files) };
    auto& flat = found.flattened.flat;
    if (! (setup.rate_hz >= 1.0 && setup.rate_hz <= 1e6))
        flat.error ("graph/rate", flat.at ({}, "rate_hz"), "the rate must be from 1 Hz to 1 MHz", "haptic graphs run at 1000 to 10000 Hz");

    check (flat, setup, g, found);
    auto spent = spentOn (flat);
    for (const auto& [name, patch] : g.graphs)   // an unused subgraph is checked on its own
        if (! found.flattened.used.contains (&patch) && ! spent.is_over)
        {
            Examined alone { .flattened = flattenUnused (g, name, patch, catalogue, assets, spent, files) };
            check (alone.flattened.flat, setup, g, alone);
            spent = spentOn (alone.flattened.flat);
            std::ranges::move (alone.flattened.flat.messages, std::back_inserter (flat.messages));
        }
    return found;
}

}   // namespace tactus::plan
