// SPDX-License-Identifier: MIT
#include "regroup.hpp"

#include "endpoints.hpp"
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
        for (const auto* key : { "count", "every", "times" })
            if (node.extra.contains (key)) return cannot ("has a `" + std::string (key) + "`");
        if (! node.roles.is_null() && ! mapsRoles()) return cannot ("gives roles to several instances");
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
    Message cannot (const std::string& why) const
    {
        Message m;
        m.id = "edit/cannot_expand";
        m.text = inQuotes (command.name) + " " + why;
        m.remedy = "change that first";
        return m;
    }

    bool mapsRoles() const
    {
        return node.roles.is_object() && std::ranges::all_of (node.roles, [] (const Json& outer)
                                                              { return outer.is_string(); });
    }

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
        if (! node.roles.is_object()) return;
        const auto outerOf = [&] (const std::string& role)
        { return node.roles.contains (role) ? node.roles.at (role).get<std::string>() : role; };
        if (! n.role.empty()) n.role = outerOf (n.role);
        if (n.type.find (':') == std::string::npos) return;

        auto roles = Json::object();
        if (n.roles.is_object())
            for (const auto& [role, outer] : n.roles.items())
                append (roles, role, outer.is_string() ? Json (outerOf (outer.get<std::string>())) : outer);
        for (const auto& [role, outer] : node.roles.items())
            if (! roles.contains (role)) append (roles, role, outer);
        n.roles = std::move (roles);
    }

    /// What the node said of the params inside is said inside. Later values outrank earlier ones, so they are put last.
    std::optional<Message> giveValues (const Json& values, bool of_shown)
    {
        for (const auto& [key, value] : values.items())
        {
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

            const auto first = firstNameOf (e.node);
            const auto n = std::ranges::find (inner.nodes, first, &Node::name);
            if (n == inner.nodes.end() || e.node.starts_with (first + "[")) return cannot ("has a value for " + inQuotes (key) + ", and there is no such node inside");
            const bool deeper = e.node.size() > first.size();
            auto& into = deeper ? n->overrides : n->params;
            const auto text = toText (Endpoint { deeper ? e.node.substr (first.size() + 1) : "x", e.port, e.index, e.component });
            const auto wanted = deeper ? text : text.substr (2);
            auto changed = Json::object();
            for (const auto& [k, v] : into.items())
                if (k != wanted) append (changed, k, v);
            append (changed, wanted, value);
            into = std::move (changed);
        }
        return std::nullopt;
    }

    /// What a port that the subgraph shows stands for.
    std::optional<Endpoint> throughShown (const Endpoint& e, Side side) const
    {
        using List = const std::vector<std::pair<std::string, Endpoint>>*;
        const auto lists = side == Side::start ? std::vector<List> { &inner.expose.outputs } : side == Side::end ? std::vector<List> { &inner.expose.inputs, &inner.expose.params }
                                                                                                                 : std::vector<List> { &inner.expose.params };
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
        const auto originOf = [] (const auto& x)
        { return x.origin.empty() ? std::vector { x.id } : x.origin; };
        const auto around = originOf (node);
        const auto copy = [&] (auto& x)
        {
            auto origin = around;
            std::ranges::copy (originOf (x), std::back_inserter (origin));
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

std::optional<Message> expand (Graph& graph, const ExpandNode& command) { return Expand (graph, command).run(); }

}   // namespace tactus::graph
