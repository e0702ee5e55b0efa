// SPDX-License-Identifier: MIT
#include "regroup.hpp"

#include "endpoints.hpp"
#include "instances.hpp"
#include "overrides.hpp"
#include "separate.hpp"
#include "text.hpp"

#include <framework/file/json_text.hpp>
#include <framework/in_quotes.hpp>

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
    return std::ranges::find (graph.graphs, name, [] (const auto& g) -> const std::string&
                              { return g.first; })
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
        forEachEndpoint (graph, [&] (Endpoint& e, const Waypoint& p)
                         {
                             if (p.patch == &patchOf (graph, command.patch) && members.contains (p.name)) e.node.insert (p.begin, command.name + "/");
                             return true; });

        for (auto& wire : wires)
        {
            const bool starts = isInside (wire.from), ends = isInside (wire.to);
            if (starts && ends)
            {
                inner.wires.push_back (std::move (wire));
                continue;
            }
            if (starts) wire.from = shown (wire.from, inner.expose.outputs);
            if (ends) wire.to = shown (wire.to, inner.expose.inputs);
            patchOf (graph, command.patch).wires.push_back (std::move (wire));
        }
        moveNodes();
        graph.graphs.emplace_back (command.subgraph, std::move (inner));
    }

private:
    bool isInside (const Endpoint& e) const { return members.contains (firstNameOf (e.node)); }

    /// The port of the new node that stands for one inside. Which entry or component of it is meant is said outside.
    Endpoint shown (const Endpoint& e, std::vector<std::pair<std::string, Endpoint>>& list)
    {
        const Endpoint whole { e.node, e.port };
        auto at = std::ranges::find (list, whole, &std::pair<std::string, Endpoint>::second);
        if (at == list.end())
        {
            const auto isTaken = [&] (const std::string& name)
            { return used.contains (name); };
            const auto node = firstNameOf (e.node);
            const auto name = isTaken (e.port) ? freeName (node + "_" + e.port, isTaken) : e.port;
            used.insert (name);
            at = list.insert (list.end(), { name, whole });
        }
        return { command.name, at->first, e.index, e.component };
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
    std::set<std::string> used;   // names of ports that are shown
};

//==============================================================================
class Expand
{
public:
    Expand (Graph& g, const ExpandNode& c) : graph (g), command (c), node (*patchOf (g, c.patch).find (c.name)) {}

    std::optional<Message> run()
    {
        const auto* body = node.type.starts_with ("graph:") ? graph.find (node.type.substr (6)) : nullptr;
        if (body == nullptr) return cannot ("is a node of no subgraph in this graph");
        if (node.bypass) return cannot ("is bypassed");
        for (const auto* key : { "every", "times" })
            if (node.extra.contains (key)) return cannot ("has a `" + std::string (key) + "`");
        if (node.roles.is_object() && std::ranges::any_of (node.roles, [] (const Json& outer)
                                                           { return outer.is_array() && outer.size() != 1; }))
            return cannot ("gives roles to several instances");
        for (const auto& n : body->nodes)
            if (n.type == node.type) return cannot ("contains itself");
        inner = *body;

        chooseNames();
        rename();
        for (auto& n : inner.nodes)
            giveRoles (n);
        if (auto problem = giveValues (node.params, true)) return problem;
        if (auto problem = giveValues (node.overrides, false)) return problem;
        if (auto problem = reroute()) return problem;
        takePlace();
        return std::nullopt;
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
                taken.insert (names[n.name] = freeName (command.name + "_" + n.name, [&] (const std::string& name)
                                                        { return taken.contains (name); }));
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
        const auto outerOf = [&] (const Json& role)
        { return role.is_string() && outer.contains (role.get<std::string>()) ? outer.at (role.get<std::string>()) : role; };
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

    /// What the node said of the params inside is said inside, where it outranks what is there.
    std::optional<Message> giveValues (const Json& values, bool of_shown)
    {
        for (const auto* entry : byPrecedence (values))
        {
            const auto& [key, value] = *entry;
            const auto parsed = parseEndpoint (of_shown ? "x." + key : key);
            if (! std::holds_alternative<Endpoint> (parsed)) return cannot ("has a value for " + inQuotes (key) + ", which names no parameter inside");
            auto e = std::get<Endpoint> (parsed);
            if (of_shown)
            {
                const auto inside = throughShown (e, Side::param);
                if (! inside) return cannot ("has a value for " + inQuotes (key) + ", which its subgraph does not show");
                e = *inside;
            }
            else
                renameEnd (e);

            const auto step = firstStep (e.node);
            const auto n = std::ranges::find (inner.nodes, step.name, &Node::name);
            if (n == inner.nodes.end()) return cannot ("has a value for " + inQuotes (key) + ", and there is no such node inside");
            if (auto problem = give (*n, e, value)) return problem;
        }
        return std::nullopt;
    }

    /// A shown parameter of a node that says more about its inside becomes one of that, to stay above it.
    std::optional<Message> give (Node& n, const Endpoint& e, const Json& value) const
    {
        const auto step = firstStep (e.node);
        const auto instance = step.instance >= 0 ? "[" + std::to_string (step.instance) + "]/" : "";
        if (! step.rest.empty())
            giveOverride (n.overrides, instance + toText ({ std::string (step.rest), e.port, e.index, e.component }), value);
        else if (const auto* inside = subgraphOf (n); inside && (! instance.empty() || ! n.overrides.empty()))
        {
            auto shown = shownBy (*inside, e, Side::param);
            if (! shown) return cannot ("has a value for " + inQuotes (toText (e)) + ", and there is no such parameter inside");
            giveOverride (n.overrides, instance + toText (*shown), value);
        }
        else if (! instance.empty())
            return cannot ("has a value for " + inQuotes (toText (e)) + ", one instance of a subgraph in another file");
        else
        {
            auto changed = Json::object();
            const auto wanted = toText ({ "x", e.port, e.index, e.component }).substr (2);
            for (const auto& [k, v] : n.params.items())
                if (k != wanted) append (changed, k, v);
            append (changed, wanted, value);
            n.params = std::move (changed);
        }
        return std::nullopt;
    }

    const Patch* subgraphOf (const Node& n) const { return n.type.starts_with ("graph:") ? graph.find (std::string_view (n.type).substr (6)) : nullptr; }

    std::optional<Endpoint> throughShown (const Endpoint& e, Side side) const { return shownBy (inner, e, side); }

    /// What a port that a subgraph shows stands for.
    static std::optional<Endpoint> shownBy (const Patch& patch, const Endpoint& e, Side side)
    {
        using List = const std::vector<std::pair<std::string, Endpoint>>*;
        const auto lists = side == Side::start ? std::vector<List> { &patch.expose.outputs } : side == Side::end ? std::vector<List> { &patch.expose.inputs, &patch.expose.params }
                                                                                                                 : std::vector<List> { &patch.expose.params };
        for (const auto* list : lists)
            if (const auto at = std::ranges::find (*list, e.port, &std::pair<std::string, Endpoint>::first); at != list->end())
            {
                auto inside = at->second;
                if (e.index >= 0) inside.index = e.index;
                if (e.component >= 0) inside.component = e.component;
                return inside;
            }
        return std::nullopt;
    }

    std::optional<Message> reroute()
    {
        const auto* patch = &patchOf (graph, command.patch);
        std::optional<Message> problem;
        forEachEndpoint (graph, [&] (Endpoint& e, const Waypoint& p)
                         {
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
                             const auto inside = throughShown (e, p.side);
                             if (! inside)
                             {
                                 problem = cannot ("is asked for " + inQuotes (e.port) + ", which its subgraph does not show");
                                 return false;
                             }
                             e = *inside;
                             e.node.insert (0, before);
                             return true; });
        return problem;
    }

    void takePlace()
    {
        const auto type = node.type;
        const auto id = node.id;
        auto& patch = patchOf (graph, command.patch);
        const auto isOfIt = [&] (const Node& n)
        { return n.type == type && n.id != id; };
        const bool shared = std::ranges::any_of (graph.root.nodes, isOfIt) || std::ranges::any_of (graph.graphs, [&] (const auto& g)
                                                                                                   { return std::ranges::any_of (g.second.nodes, isOfIt); });
        const auto around = ancestryOf (node);
        const auto copy = [&] (auto& x)
        {
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
        const auto at = patch.nodes.erase (std::ranges::find (patch.nodes, command.name, &Node::name));
        patch.nodes.insert (at, std::make_move_iterator (inner.nodes.begin()), std::make_move_iterator (inner.nodes.end()));
        std::ranges::move (inner.wires, std::back_inserter (patch.wires));
        if (! shared) std::erase_if (graph.graphs, [&] (const auto& g)
                                     { return "graph:" + g.first == type; });
    }

    Graph& graph;
    const ExpandNode& command;
    const Node& node;
    Patch inner;
    std::map<std::string, std::string> names;   // inside, and what they become
};
}   // namespace

std::optional<Message> collapse (Graph& graph, const CollapseNodes& command)
{
    Collapse (graph, command).run();
    return std::nullopt;
}

std::optional<Message> expand (Graph& graph, const ExpandNode& command)
{
    const bool counted = patchOf (graph, command.patch).find (command.name)->extra.contains ("count");
    return counted ? separate (graph, command) : Expand (graph, command).run();
}

}   // namespace tactus::graph
