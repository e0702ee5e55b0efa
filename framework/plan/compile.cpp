// SPDX-License-Identifier: MIT
#include "compile.hpp"
#include <tactus/plan/build/build.hpp>
#include <tactus/plan/prepared_shelf.hpp>
#include <tactus/plan/rules/examine.hpp>

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

Compiled compileAll (const graph::Graph& g, const Catalogue& catalogue, const CompileOptions& options)
{
    beginReading();
    const double rate = options.rate_hz > 0.0 ? options.rate_hz : g.rate_hz;
    Setup setup { .rate_hz = rate, .services = options.services };
    if (setup.services.prepared == nullptr) setup.services.prepared = &plan::preparedOfAll();
    auto [flattened, units, ordered] = examine (g, catalogue, setup, options.overrides, options.assets);
    auto& flat = flattened.flat;
    auto& top = flattened.top;
    auto outside = findOutside (flat, *top, options);

    auto messages = std::move (flat.messages);
    if (! canRun (messages)) return { nullptr, std::move (messages) };

    flat.messages.clear();
    auto made = build (flat, units, ordered, std::move (outside), setup, options);
    std::ranges::move (flat.messages, std::back_inserter (messages));
    return { std::move (made), std::move (messages) };
}
}   // namespace

Messages problemsOf (const graph::Graph& g, const Catalogue& catalogue)
{
    try
    {
        return std::move (examine (g, catalogue, { .rate_hz = g.rate_hz, .services = {} }, {}, nullptr, SettingFiles::left_out).flattened.flat.messages);
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
