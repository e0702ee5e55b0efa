// SPDX-License-Identifier: MIT
#include "compile.hpp"
#include <tactus/plan/build/build.hpp>
#include <tactus/plan/build/slots.hpp>
#include <tactus/plan/flat/device_of.hpp>
#include <tactus/plan/flat/make_node.hpp>
#include <tactus/plan/flat/sections.hpp>
#include <tactus/plan/rules/aliasing.hpp>
#include <tactus/plan/rules/wire_fit.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/node/node_fault.hpp>
#include <tactus/text/budget.hpp>

#include <iterator>
#include <map>
#include <utility>

namespace tactus
{

namespace
{
using namespace plan;

/// True if there are no errors except unknown types. A node of an unknown type becomes a placeholder, whose outputs are 0.
bool canRun (const Messages& messages)
{
    return std::ranges::none_of (messages, [] (const Message& m) { return m.severity == Message::Severity::error && m.id != "node/unknown_type"; });
}

/// Delayed wires take memory, and even a short file can request more than the machine has.
void checkDelays (Flat& flat)
{
    for (const auto& w : flat.wires)
        if (w.delay > 0 && ! flat.spend (0.0, sizeof (double) * static_cast<double> (w.delay) * flat.widthOf (w.to), w.origin)) return;
}

/// Several wires into one port are summed if the quantity can be summed; otherwise this is an error that names both wires. The
/// same applies to one wire that starts from several instances, even into ports that accept only one wire.
void checkFanIn (Flat& flat, const PortUnits& units)
{
    const auto inWords = [] (Quantity q) { return q == Quantity::any ? "value" : std::string (name (q)); };
    const Slots slots (flat);
    std::vector<const FlatWire*> taken (slots.count(), nullptr);
    Identity wrong {};   // the wire reported last
    for (const auto& w : flat.wires)
    {
        if (w.identity == wrong || w.add) continue;
        const int first = w.to.component >= 0 ? w.to.component : 0;
        for (int c = first; c < first + flat.widthOf (w.to); ++c)
        {
            auto*& other = taken[slots (w.to, c)];
            if (other == nullptr)
            {
                other = &w;
                continue;
            }
            if (w.to.role == Role::input && (addsUp (units (w.to).quantity) || flat.sheet (w.to).unit.adds_up)) break;
            if (other->identity == w.identity)
            {
                const auto quantity = w.from ? units (*w.from).quantity : Quantity::any;
                if (addsUp (quantity)) continue;
                flat.error ("wire/which_instance", w.origin,
                            "\"" + toText (*w.written) + "\" starts from several instances, but a " + inWords (quantity) + " cannot be summed",
                            other->from ? "name one instance, as in " + flat.nameOf (*other->from) : "name one instance");
            }
            else
                flat.error ("wire/two_into_one", w.origin,
                            "\"" + toText (*other->written) + "\" and \"" + toText (*w.written) + "\" both end at '" + flat.nameOf (w.to) + "', but a "
                                + inWords (units (w.to).quantity) + " cannot be summed",
                            w.to.role == Role::param ? "add the second wire with (+), or remove one of the two"
                                                     : "join the two wires in a signal.add or vector.add node, or remove one of them");
            wrong = w.identity;
            break;
        }
    }
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
PortUnits check (Flat& flat, const Setup& setup, const graph::Graph& graph, Order& ordered)
{
    auto units = checkUnits (flat);
    checkFanIn (flat, units);
    checkDelays (flat);
    findDevices (flat);
    askNodes (flat, setup, graph);
    ordered = order (flat);
    checkSections (flat, setup.rate_hz);
    warnOfAliasing (flat, units, setup);
    return units;
}

/// Collects the params and inputs that subgraphs expose, by their full names.
void addExposed (const Scope& scope, std::map<std::string, Ports>& all)
{
    for (const auto& member : scope.members)
        for (const auto& inside : member.instances)
        {
            if (inside->stand_in >= 0) continue;
            for (const auto& x : inside->exposed)
                if (x.role != Role::output && ! x.to.empty()) all.emplace (inside->prefix.substr (0, inside->prefix.size() - 1) + "." + x.name, x.to);
            addExposed (*inside, all);
        }
}

/// If two feed columns drive one port, the column that names more single instances takes precedence.
void dropGeneral (std::vector<Ports>& feeds, const std::vector<std::string>& names)
{
    if (std::ranges::all_of (feeds, [] (const Ports& p) { return p.size() <= 1; }))
        return;
    for (std::size_t f = 0; f < feeds.size(); ++f)
        std::erase_if (feeds[f], [&] (const PortRef& port) {
            for (std::size_t other = 0; other < feeds.size(); ++other)
                if (graph::namedInstances (names[other]) > graph::namedInstances (names[f]) && std::ranges::count (feeds[other], port) > 0)
                    return true;
            return false;
        });
}

void readFeeds (Flat& flat, const Scope& top, const std::vector<std::string>& names, std::vector<Ports>& feeds)
{
    for (const auto& name : names)
    {
        const auto origin = flat.asIs ({}, "feed column " + name);
        auto& ports = feeds.emplace_back();
        find (name, Side::end, top, origin, flat, ports);
        for (const auto& port : ports)
        {
            const auto& sheet = flat.sheet (port);
            if (! sheet.choices.empty())
                flat.error ("feed/choice", origin, "'" + name + "' takes one of a list of names, so numbers cannot be fed into it",
                            "set the parameter with --set, or in the graph file");
            else if (flat.widthOf (port) != 1)
                flat.error ("feed/width", origin, "'" + name + "' is a vector", "feed its components: " + name + ".x, " + name + ".y, " + name + ".z");
            else if (sheet.list && port.index < 0)
                flat.error ("feed/width", origin, "'" + name + "' is an array port", "feed its entries: " + name + "[0], …");
            else
                continue;
            break;
        }
    }
    dropGeneral (feeds, names);
}

/// Finds the ports to record. Each instance gets its own columns, with the number of the instance in their names.
void readRecord (Flat& flat, const Scope& top, const std::string& name, std::vector<Outside::Read>& records)
{
    const auto origin = flat.asIs ({}, "record " + name);
    Ports ports;
    const auto asked = graph::parseEndpoint (name);
    if (! asked)
    {
        find (name, Side::record, top, origin, flat, ports);
        return;
    }
    for (auto& path : spelledOut (asked->node, top))
    {
        auto one = *asked;
        one.node = std::move (path);
        if (! find (one, Side::record, top, origin, flat, ports)) return;
        const auto column = one.node == asked->node ? name : graph::toText (one);
        if (ports.empty()) records.push_back ({ column, {} });
        for (const auto& port : ports)
        {
            if (! flat.sheet (port).choices.empty())
            {
                flat.error ("record/choice", origin, "'" + name + "' takes one of a list of names, so there is no number to record",
                            "record a port that carries a number");
                return;
            }
            records.push_back ({ ports.size() == 1 ? column : flat.nameOf (port), port });
        }
    }
}

Outside findOutside (Flat& flat, const Scope& top, const CompileOptions& options)
{
    Outside outside;
    readFeeds (flat, top, options.feeds, outside.feeds);
    for (const auto& name : options.records)
        readRecord (flat, top, name, outside.records);
    if (options.records.empty())
        for (int n = 0; n < flat.nodeCount(); ++n)
            if (const auto& node = flat.node (n); node.type->effort && ! node.muted)
                for (int p = 0; p < static_cast<int> (node.type->inputs.size()); ++p)
                {
                    const PortRef port { n, Role::input, p, -1, -1 };
                    outside.records.push_back ({ flat.nameOf (port), port });
                }
    addExposed (top, outside.exposed);
    return outside;
}

/// What the steps before building find out about a graph, and all errors and warnings.
struct Examined
{
    Flattened flattened;
    PortUnits units;
    Order order;
};

Examined examine (const graph::Graph& g, const Catalogue& catalogue, const CompileOptions& options, const Setup& setup,
                  SettingFiles files = SettingFiles::read)
{
    Examined found { .flattened = flatten (g, catalogue, options.overrides, options.assets, files), .units = {}, .order = {} };
    auto& flat = found.flattened.flat;
    if (! (setup.rate_hz >= 1.0 && setup.rate_hz <= 1e6))
        flat.error ("graph/rate", flat.at ({}, "rate_hz"), "the rate must be from 1 Hz to 1 MHz", "haptic graphs run at 1000 to 10000 Hz");

    found.units = check (flat, setup, g, found.order);
    auto spent = spentOn (flat);
    for (const auto& [name, patch] : g.graphs)   // an unused subgraph is checked on its own
        if (! found.flattened.used.contains (&patch) && ! spent.is_over)
        {
            auto alone = flattenUnused (g, name, patch, catalogue, options.assets, spent, files);
            Order unneeded;
            check (alone.flat, setup, g, unneeded);
            spent = spentOn (alone.flat);
            flat.messages.insert (flat.messages.end(), alone.flat.messages.begin(), alone.flat.messages.end());
        }
    return found;
}

Compiled compileAll (const graph::Graph& g, const Catalogue& catalogue, const CompileOptions& options)
{
    beginReading();
    const double rate = options.rate_hz > 0.0 ? options.rate_hz : g.rate_hz;
    const Setup setup { .rate_hz = rate, .services = options.services };
    auto [flattened, units, ordered] = examine (g, catalogue, options, setup);
    auto& flat = flattened.flat;
    auto& top = flattened.top;
    auto outside = findOutside (flat, *top, options);

    auto messages = std::move (flat.messages);
    if (! canRun (messages)) return { nullptr, std::move (messages) };

    flat.messages.clear();
    const auto lanes = groupLanes (flat, ordered, outside, options.lanes, rate);
    auto made = build (flat, units, ordered, lanes, std::move (outside), setup, options);
    std::ranges::move (flat.messages, std::back_inserter (messages));
    return { std::move (made), std::move (messages) };
}
}   // namespace

Messages problemsOf (const graph::Graph& g, const Catalogue& catalogue)
{
    try
    {
        return std::move (examine (g, catalogue, {}, { .rate_hz = g.rate_hz, .services = {} }, SettingFiles::left_out).flattened.flat.messages);
    }
    catch (const NodeFault&)
    {
        return {};   // compile() reports it
    }
}

Compiled compile (const graph::Graph& g, const Catalogue& catalogue, const CompileOptions& options)
{
    try
    {
        return compileAll (g, catalogue, options);
    }
    catch (const NodeFault& fault)
    {
        return { nullptr, { Message::error ("plugin/failed", "", fault.what(), "ask the author of the plugin, or use another node") } };
    }
}

}   // namespace tactus
