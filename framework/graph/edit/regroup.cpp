// SPDX-License-Identifier: MIT
#include "regroup.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/graph/overrides.hpp>

#include <tactus/text/json_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace tactus::graph
{
namespace
{
Patch& patchOf (Graph& graph, const std::string& name)
{
    if (name.empty()) return graph.root;
    return std::ranges::find (graph.graphs, name, [] (const auto& g) -> const std::string& { return g.first; })
        ->second;
}

template <typename Taken>
std::string freeName (std::string wanted, Taken isTaken)
{
    if (! isTaken (wanted)) return wanted;
    for (int i = 2;; ++i)
        if (auto name = wanted + "_" + std::to_string (i); ! isTaken (name)) return name;
}

//==============================================================================
class Collapse
{
public:
    Collapse (Graph& g, const CollapseNodes& c) : graph (g), command (c), members (c.nodes.begin(), c.nodes.end()) {}

    void run()
    {
        auto wires = std::exchange (patchOf (graph, command.patch).wires, {});
        auto shown = std::exchange (patchOf (graph, command.patch).expose, {});
        forEachEndpoint (graph, [&] (Endpoint& e, const Waypoint& p) {
            if (p.patch == &patchOf (graph, command.patch) && members.contains (p.name)) e.node.insert (p.begin, command.name + "/");
            return true;
        });

        // In a subgraph, what it exposes of these nodes, the new one exposes, too.
        expose (shown.params, inner.expose.params);
        expose (shown.inputs, inner.expose.inputs);
        expose (shown.outputs, inner.expose.outputs);
        patchOf (graph, command.patch).expose = std::move (shown);

        for (auto& wire : wires)
        {
            const bool starts = isInside (wire.from), ends = isInside (wire.to);
            if (starts && ends)
            {
                inner.wires.push_back (std::move (wire));
                continue;
            }
            if (starts) wire.from = exposed (wire.from, inner.expose.outputs);
            if (ends) wire.to = wire.add ? exposedParam (wire.to) : exposed (wire.to, isExposedParam (wire.to) ? inner.expose.params : inner.expose.inputs);
            patchOf (graph, command.patch).wires.push_back (std::move (wire));
        }
        moveNodes();
        graph.graphs.emplace_back (command.subgraph, std::move (inner));
    }

private:
    using Exposed = std::vector<std::pair<std::string, Endpoint>>;

    bool isInside (const Endpoint& e) const { return members.contains (firstNameOf (e.node)); }

    bool isExposedParam (const Endpoint& e) const
    {
        return std::ranges::count (inner.expose.params, Endpoint { e.node, e.port }, &Exposed::value_type::second) > 0;
    }

    void expose (Exposed& shown, Exposed& list)
    {
        for (auto& [name, e] : shown)
            if (isInside (e)) e = exposed (e, list);
    }

    /// The param of the new node for one to which a wire adds. An entry of a list is exposed on its own, so that its value and its depth are seen outside.
    Endpoint exposedParam (const Endpoint& e)
    {
        return isExposedParam (e) ? exposed (e, inner.expose.params) : exposed (e, { e.node, e.port, e.index }, inner.expose.params);
    }

    /// The port of the new node that exposes an inner port as a whole; the outer endpoint selects the entry or component.
    Endpoint exposed (const Endpoint& e, Exposed& list) { return exposed (e, { e.node, e.port }, list); }

    Endpoint exposed (const Endpoint& e, const Endpoint& shown, Exposed& list)
    {
        auto port = std::ranges::find (list, shown, &Exposed::value_type::second);
        if (port == list.end())
        {
            const auto isTaken = [&] (const std::string& name) { return used.contains (name); };
            const auto node = firstNameOf (e.node);
            const auto name = isTaken (e.port) ? freeName (node + "_" + e.port, isTaken) : e.port;
            used.insert (name);
            port = list.insert (list.end(), { name, shown });
        }
        return { command.name, port->first, shown.index < 0 ? e.index : -1, e.component };
    }

    void moveNodes()
    {
        auto& nodes = patchOf (graph, command.patch).nodes;
        std::vector<Node> kept;
        for (auto& n : nodes)
        {
            if (! members.contains (n.name))
            {
                kept.push_back (std::move (n));
                continue;
            }
            if (inner.nodes.empty())
            {
                kept.emplace_back();
                kept.back().name = command.name;
                kept.back().type = "graph:" + command.subgraph;
            }
            inner.nodes.push_back (std::move (n));
        }
        nodes = std::move (kept);
    }

    Graph& graph;
    const CollapseNodes& command;
    const std::set<std::string> members;
    Patch inner;
    std::set<std::string> used;   // names of exposed ports
};

//==============================================================================
class Expand
{
public:
    Expand (Graph& g, const ExpandNode& c) : graph (g), command (c), node (*patchOf (g, c.patch).find (c.name)) {}

    Result<> run()
    {
        const auto* body = node.type.starts_with ("graph:") ? graph.find (node.type.substr (6)) : nullptr;
        if (body == nullptr) return cannot ("is not a subgraph of this graph");
        if (node.bypass) return cannot ("is bypassed");
        for (const auto* key : { "every", "times" })
            if (node.extra.contains (key)) return cannot ("uses `" + std::string (key) + "`");
        if (node.roles.is_object() && std::ranges::any_of (node.roles, [] (const Json& outer) { return outer.is_array() && outer.size() != 1; }))
            return cannot ("gives roles to several instances");
        for (const auto& n : body->nodes)
            if (n.type == node.type) return cannot ("contains itself");
        inner = *body;

        chooseNames();
        rename();
        for (auto& n : inner.nodes)
            giveRoles (n);
        if (auto done = giveValues (node.params, true); ! done) return done;
        if (auto done = giveValues (node.overrides, false); ! done) return done;
        if (auto done = reroute(); ! done) return done;
        takePlace();
        return {};
    }

private:
    Message cannot (const std::string& why) const { return cannotExpand (command.name, why); }

    void chooseNames()
    {
        std::set<std::string> taken;
        for (const auto& n : patchOf (graph, command.patch).nodes)
            if (n.name != command.name) taken.insert (n.name);
        for (const auto& n : inner.nodes)
            if (! taken.contains (n.name)) taken.insert (names[n.name] = n.name);
        for (const auto& n : inner.nodes)
            if (! names.contains (n.name))
                taken.insert (names[n.name] = freeName (command.name + "_" + n.name, [&] (const std::string& name) { return taken.contains (name); }));
    }

    void renameEnd (Endpoint& e) const
    {
        const auto first = firstNameOf (e.node);
        if (const auto to = names.find (first); to != names.end()) e.node.replace (0, first.size(), to->second);
    }

    void rename()
    {
        for (auto& n : inner.nodes)
            n.name = names.at (n.name);
        for (auto& w : inner.wires)
        {
            renameEnd (w.from);
            renameEnd (w.to);
        }
        for (auto* list : { &inner.expose.inputs, &inner.expose.outputs, &inner.expose.params })
            for (auto& [name, end] : *list)
                renameEnd (end);
    }

    void giveRoles (Node& n) const
    {
        const auto outer = rolesOf (node, 0);
        if (! outer.is_object()) return;
        const auto outerOf = [&] (const Json& role) {
            const bool is_renamed = role.is_string() && outer.contains (role.get<std::string>());
            return is_renamed ? outer.at (role.get<std::string>()) : role;
        };
        if (! n.role.empty()) n.role = outerOf (n.role).get<std::string>();
        if (n.type.find (':') == std::string::npos) return;

        auto roles = Json::object();
        if (n.roles.is_object())
            for (const auto& [role, means] : n.roles.items())
            {
                auto now = means;
                if (means.is_array())
                    for (auto& one : now)
                        one = outerOf (one);
                else
                    now = outerOf (means);
                append (roles, role, std::move (now));
            }
        for (const auto& [role, means] : outer.items())
            if (! roles.contains (role)) append (roles, role, means);
        n.roles = std::move (roles);
    }

    /// Moves the values that the node gives to inner params to those params, where they replace the params' own values.
    Result<> giveValues (const Json& values, bool of_exposed)
    {
        for (const auto* entry : byPrecedence (values))
        {
            const auto& [key, value] = *entry;
            const auto parsed = parseEndpoint (of_exposed ? "x." + key : key);
            if (! parsed) return cannot ("has a value for " + quote (key) + ", which names no parameter inside");
            auto e = *parsed;
            if (of_exposed)
            {
                const auto inside = exposedBy (inner, e, Side::param);
                if (! inside) return cannot ("has a value for " + quote (key) + ", which its subgraph does not expose");
                e = *inside;
            }
            else
                renameEnd (e);

            const auto step = firstStep (e.node);
            const auto n = std::ranges::find (inner.nodes, step.name, &Node::name);
            if (n == inner.nodes.end()) return cannot ("has a value for " + quote (key) + ", but there is no such node inside");
            if (auto done = give (*n, e, value); ! done) return done;
        }
        return {};
    }

    /// Gives a value to a parameter. For an exposed parameter of a node that has overrides, the value becomes an override too, to
    /// keep its precedence.
    Result<> give (Node& n, const Endpoint& e, const Json& value) const
    {
        const auto step = firstStep (e.node);
        const auto instance = step.instance >= 0 ? "[" + std::to_string (step.instance) + "]/" : "";
        if (! step.rest.empty())
            giveOverride (n.overrides, instance + toText ({ std::string (step.rest), e.port, e.index, e.component }), value);
        else if (const auto* inside = subgraphOf (n); inside && (! instance.empty() || ! n.overrides.empty()))
        {
            auto exposed = exposedBy (*inside, e, Side::param);
            if (! exposed) return cannot ("has a value for " + quote (toText (e)) + ", but there is no such parameter inside");
            giveOverride (n.overrides, instance + toText (*exposed), value);
        }
        else if (! instance.empty())
            return cannot ("has a value for " + quote (toText (e)) + ", which is one instance of a subgraph in another file");
        else
        {
            auto changed = Json::object();
            const auto wanted = toText ({ "x", e.port, e.index, e.component }).substr (2);
            for (const auto& [k, v] : n.params.items())
                if (k != wanted) append (changed, k, v);
            append (changed, wanted, value);
            n.params = std::move (changed);
        }
        return {};
    }

    const Patch* subgraphOf (const Node& n) const { return n.type.starts_with ("graph:") ? graph.find (std::string_view (n.type).substr (6)) : nullptr; }

    /// The inner port that a subgraph exposes under a name.
    static std::optional<Endpoint> exposedBy (const Patch& patch, const Endpoint& e, Side side)
    {
        const auto& [inputs, outputs, params, extra] = patch.expose;
        using List = const std::vector<std::pair<std::string, Endpoint>>*;
        std::vector<List> lists { &params };
        if (side == Side::start) lists = { &outputs };
        if (side == Side::end) lists = { &inputs, &params };
        for (const auto* list : lists)
            if (const auto port = std::ranges::find (*list, e.port, &std::pair<std::string, Endpoint>::first); port != list->end())
            {
                auto inside = port->second;
                if (e.index >= 0) inside.index = e.index;
                if (e.component >= 0) inside.component = e.component;
                return inside;
            }
        return std::nullopt;
    }

    Result<> reroute()
    {
        const auto* patch = &patchOf (graph, command.patch);
        Result<> done;
        forEachEndpoint (graph, [&] (Endpoint& e, const Waypoint& p) {
            if (p.patch != patch || p.name != command.name) return true;
            const auto before = e.node.substr (0, p.begin);
            if (p.end < e.node.size())
            {
                auto inside = e;
                inside.node = e.node.substr (p.end + 1);
                renameEnd (inside);
                e.node = before + inside.node;
                return true;
            }
            const auto inside = exposedBy (inner, e, p.side);
            if (! inside)
            {
                done = cannot ("does not expose " + quote (e.port) + ", but something refers to it");
                return false;
            }
            e = *inside;
            e.node.insert (0, before);
            return true;
        });
        return done;
    }

    void takePlace()
    {
        const auto type = node.type;
        const auto id = node.id;
        auto& patch = patchOf (graph, command.patch);
        const auto isOfIt = [&] (const Node& n) { return n.type == type && n.id != id; };
        const bool shared = std::ranges::any_of (graph.root.nodes, isOfIt)
                            || std::ranges::any_of (graph.graphs, [&] (const auto& g) { return std::ranges::any_of (g.second.nodes, isOfIt); });
        const auto around = ancestryOf (node);
        const auto copy = [&] (auto& x) {
            auto origin = around;
            std::ranges::copy (ancestryOf (x), std::back_inserter (origin));
            x.origin = std::move (origin);
            x.id = newId();
        };
        if (shared)
        {
            std::ranges::for_each (inner.nodes, copy);
            std::ranges::for_each (inner.wires, copy);
        }
        const auto place = patch.nodes.erase (std::ranges::find (patch.nodes, command.name, &Node::name));
        patch.nodes.insert (place, std::make_move_iterator (inner.nodes.begin()), std::make_move_iterator (inner.nodes.end()));
        std::ranges::move (inner.wires, std::back_inserter (patch.wires));
        if (! shared) std::erase_if (graph.graphs, [&] (const auto& g) { return "graph:" + g.first == type; });
    }

    Graph& graph;
    const ExpandNode& command;
    const Node& node;
    Patch inner;
    std::map<std::string, std::string> names;   // by name in the subgraph: the new name of the node
};
}   // namespace

Result<> collapse (Graph& graph, const CollapseNodes& command)
{
    Collapse (graph, command).run();
    return {};
}

Result<> expand (Graph& graph, const ExpandNode& command)
{
    const bool counted = patchOf (graph, command.patch).find (command.name)->extra.contains ("count");
    return counted ? separate (graph, command) : Expand (graph, command).run();
}

}   // namespace tactus::graph
