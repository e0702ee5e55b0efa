// SPDX-License-Identifier: GPL-3.0-or-later
#include "sinks.hpp"

#include <host/app/layers/mixer_parts.hpp>
#include <host/app/model/face.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/inside.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/graph/overrides.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

namespace tactus::host::compose
{

namespace
{
constexpr std::array<SinkPort, 4> sink_ports { { { "device.force", "force", true },
                                                 { "device.force", "torque", true },
                                                 { "device.effort", "effort", false },
                                                 { "device.signal_out", "in", false } } };

Message inFile (const std::string& node)
{
    return Message::error ("compose/in_file", {}, filled (TRANS ("a motor is inside %1, which is another file"), node).toStdString(),
                           TRANS ("expand that subgraph first").toStdString());
}

/// True if a patch can expose the start of this wire in place of what the wire carries.
bool isPlain (const graph::Wire& w)
{
    return w.delay == 0 && ! w.add && w.gain.is_null() && w.enabled.value_or (true) && w.to.component < 0 && w.from.component < 0
           && w.from.node.find_first_of ("[/") == std::string::npos;
}

/// Sums what goes into an input, from the patch and through what it exposes, and removes the wires into it. Empty port: nothing goes into it.
Result<graph::Endpoint> sumInto (graph::Patch& patch, const std::string& sink, const SinkPort& port)
{
    const auto leadsThere = [&] (const graph::Endpoint& e) { return e.node == sink && e.port == port.port; };
    std::vector<std::pair<graph::Endpoint*, std::string>> ends;   // with the name of what leads there
    const graph::Wire* first = nullptr;
    for (auto& w : patch.wires)
    {
        if (! leadsThere (w.to)) continue;
        if (first == nullptr) first = &w;
        ends.emplace_back (&w.to, graph::firstNameOf (w.from.node));
    }
    for (auto& [name, at] : patch.expose.inputs)
        if (leadsThere (at)) ends.emplace_back (&at, name);
    if (ends.empty()) return graph::Endpoint {};
    if (ends.size() == 1 && first != nullptr && isPlain (*first))
    {
        const auto from = first->from;
        std::erase_if (patch.wires, [id = first->id] (const graph::Wire& w) { return w.id == id; });
        return from;
    }
    if (ends.size() > static_cast<std::size_t> (list_capacity)) return mixing::mixerIsFull();
    graph::Node mixer;
    mixer.name = freeName (patch, {}, "desk");
    mixer.type = port.is_vector ? mixing::vector_mixer : mixing::number_mixer;
    std::vector<std::string> names;
    for (auto& [end, name] : ends)
    {
        *end = { mixer.name, "in", static_cast<int> (names.size()), end->component };
        names.push_back (std::move (name));
    }
    mixer.settings["inputs"] = names.size();
    mixer.settings["names"] = mixing::joined (names);
    graph::Endpoint out { mixer.name, "out" };
    patch.nodes.push_back (std::move (mixer));
    return out;
}

/// True if a wire begins at a node, or the patch exposes one of its ports.
bool isRead (const graph::Patch& patch, const std::string& node)
{
    const auto names = [&] (const graph::Endpoint& e) { return graph::firstNameOf (e.node) == node; };
    const auto& e = patch.expose;
    return std::ranges::any_of (patch.wires, [&] (const graph::Wire& w) { return names (w.from) || names (w.to); })
           || std::ranges::any_of (std::array { &e.inputs, &e.outputs, &e.params },
                                   [&] (const auto* all) { return std::ranges::any_of (*all, [&] (const auto& entry) { return names (entry.second); }); });
}

std::string freeOutput (const graph::Expose& e, std::string_view port)
{
    std::set<std::string> taken;
    for (const auto* all : { &e.inputs, &e.outputs, &e.params })
        for (const auto& [name, at] : *all)
            taken.insert (name);
    return freeName ({}, taken, port == "in" ? "signal" : std::string (port));
}

/// Takes the motors out of the subgraphs of one graph, the innermost first.
class Lifting
{
public:
    explicit Lifting (graph::Graph& graph) : g (graph) {}

    Result<> lift (const std::string& name)
    {
        if (! seen.insert (name).second) return {};
        const auto patch = [&]() -> graph::Patch& {
            return name.empty() ? g.root : std::ranges::find (g.graphs, name, &std::pair<std::string, graph::Patch>::first)->second;
        };
        const auto nodes = patch().nodes;
        for (const auto& n : nodes)
        {
            if (n.type.starts_with ("file:") && hasSinks (g, n, 0)) return inFile (n.name);
            if (! n.type.starts_with ("graph:") || g.find (n.type.substr (6)) == nullptr) continue;
            if (auto inner = lift (n.type.substr (6)); ! inner) return inner;
            for (const auto& l : lifted[n.type.substr (6)])
                wireOut (patch(), n, l);
        }
        if (name.empty()) return {};
        auto taken = takeSinks (patch());
        if (! taken) return std::move (taken).error();
        lifted[name] = std::move (*taken);
        return {};
    }

private:
    graph::Graph& g;
    std::set<std::string> seen;
    std::map<std::string, std::vector<LiftedSink>> lifted;   // by subgraph

    static bool hasSinks (const graph::Graph& owner, const graph::Node& node, int depth)
    {
        const auto inside = graph::insideOf (owner, node);
        return inside && depth < deepest_subgraph && std::ranges::any_of (inside.patch->nodes, [&] (const graph::Node& n) {
                   return ! sinkPortsOf (n).empty() || (n.isSubgraph() && hasSinks (*inside.owner, n, depth + 1));
               });
    }

    static void wireOut (graph::Patch& patch, const graph::Node& from, const LiftedSink& l)
    {
        const auto count = graph::countOf (from);
        for (int i = 0; i < std::max (1, count.value_or (1)); ++i)
        {
            const auto roles = graph::rolesOf (from, i);
            const auto mapped = roles.find (l.sink.role);
            const auto role = mapped != roles.end() && mapped->is_string() ? mapped->asString() : l.sink.role;
            graph::Wire w;
            w.from = { count ? from.name + '[' + std::to_string (i) + ']' : from.name, l.output };
            w.to = { sinkFor (patch, l, role), std::string (l.port.port) };
            patch.wires.push_back (std::move (w));
        }
    }
};

using Roles = std::function<std::string (const std::string&)>;

void collectRoles (const graph::Graph& owner, const graph::Patch& patch, const Roles& outside, int depth, std::vector<std::string>& found)
{
    if (depth > deepest_subgraph) return;
    for (const auto& n : patch.nodes)
    {
        if (n.type.starts_with ("device.") && ! n.role.empty())
            if (const auto role = outside (n.role); std::ranges::count (found, role) == 0) found.push_back (role);
        const auto inside = n.isSubgraph() ? graph::insideOf (owner, n) : graph::Inside {};
        if (! inside) continue;
        const int most = n.roles.is_object() ? graph::countOf (n).value_or (1) : 1;
        for (int i = 0; i < most; ++i)
        {
            const auto roles = graph::rolesOf (n, i);
            const auto through = [&] (const std::string& role) {
                const auto mapped = roles.find (role);
                return outside (mapped != roles.end() && mapped->is_string() ? mapped->asString() : role);
            };
            collectRoles (*inside.owner, *inside.patch, through, depth + 1, found);
        }
    }
}
}   // namespace

std::vector<SinkPort> sinkPortsOf (const graph::Node& n)
{
    std::vector<SinkPort> found;
    for (const auto& p : sink_ports)
        if (n.type == p.type && ! n.bypass) found.push_back (p);
    return found;
}

Result<std::vector<LiftedSink>> takeSinks (graph::Patch& patch)
{
    std::vector<LiftedSink> taken;
    const auto nodes = patch.nodes;
    for (const auto& n : nodes)
    {
        const auto ports = sinkPortsOf (n);
        for (const auto& port : ports)
        {
            auto from = sumInto (patch, n.name, port);
            if (! from) return std::move (from).error();
            if (from->port.empty()) continue;
            const auto output = freeOutput (patch.expose, port.port);
            patch.expose.outputs.emplace_back (output, *from);
            graph::Node sink;
            sink.name = n.name;
            sink.type = n.type;
            sink.role = n.role;
            sink.params = n.params;
            sink.settings = n.settings;
            taken.push_back ({ output, std::move (sink), port });
        }
        if (! ports.empty() && ! isRead (patch, n.name)) std::erase_if (patch.nodes, [&] (const graph::Node& m) { return m.name == n.name; });
    }
    return taken;
}

Result<> liftSinks (graph::Graph& g)
{
    std::string named;
    graph::forEachEndpoint (g, [&] (graph::Endpoint& e, const graph::Waypoint& w) {
        const auto* node = w.begin > 0 && w.side != graph::Side::param && w.end == e.node.size() ? w.patch->find (w.name) : nullptr;
        if (node != nullptr && ! sinkPortsOf (*node).empty()) named = e.node;
        return true;
    });
    if (! named.empty())
        return Message::error ("compose/in_path", {}, filled (TRANS ("a wire from outside leads to the motor %1"), named).toStdString(),
                               TRANS ("expose that port of the subgraph, and wire to the subgraph").toStdString());
    return Lifting (g).lift ({});
}

std::string sinkFor (graph::Patch& root, const LiftedSink& l, const std::string& role)
{
    for (const auto& n : root.nodes)
        if (n.type == l.sink.type && n.role == role && ! n.bypass && n.params == l.sink.params && n.settings == l.sink.settings) return n.name;
    auto node = l.sink;
    node.id = graph::newId();
    node.name = freeName (root, {}, l.sink.name);
    node.role = role;
    root.nodes.push_back (node);
    return node.name;
}

std::vector<std::string> rolesIn (const graph::Graph& g)
{
    std::vector<std::string> found;
    collectRoles (
        g, g.root, [] (const std::string& role) { return role; }, 0, found);
    return found;
}

}   // namespace tactus::host::compose
