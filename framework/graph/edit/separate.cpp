// SPDX-License-Identifier: MIT
#include "regroup.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/graph/overrides.hpp>

#include <tactus/kit/at.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <set>

namespace tactus::graph
{
namespace
{
class Separate
{
public:
    Separate (Graph& g, const ExpandNode& c)
        : graph (g), command (c), patch (c.patch.empty() ? g.root : std::ranges::find (g.graphs, c.patch, &std::pair<std::string, Patch>::first)->second),
          node (*patch.find (c.name)), count (countOf (node).value_or (0))
    {
    }

    Result<> run()
    {
        if (count == 0) return cannot ("has a `count` that is not a whole number of at least 1");
        if (node.roles.is_object() && ! std::ranges::all_of (node.roles, [&] (const Json& outer) { return ! outer.is_array() || outer.size() == at (count); }))
            return cannot ("gives roles to a different number of instances than it has");

        chooseNames();
        inPatch (graph.root);
        for (auto& [name, p] : graph.graphs)
            inPatch (p);
        for (auto& control : graph.controls)
            inControl (control);
        if (done) takePlace();
        return std::move (done);
    }

private:
    Message cannot (const std::string& why) const { return cannotExpand (command.name, why); }

    void chooseNames()
    {
        std::set<std::string> taken;
        for (const auto& n : patch.nodes)
            taken.insert (n.name);
        for (int k = 0; k < count; ++k)
        {
            auto name = command.name + "_" + std::to_string (k);
            for (int i = 2; taken.contains (name); ++i)
                name = command.name + "_" + std::to_string (k) + "_" + std::to_string (i);
            taken.insert (name);
            names.push_back (std::move (name));
        }
    }

    const Patch* subgraphOf (const Node* n) const
    {
        return n != nullptr && n->type.starts_with ("graph:") ? graph.find (std::string_view (n->type).substr (6)) : nullptr;
    }

    /// The paths that a path relative to a patch becomes: several if it refers to all instances.
    std::vector<std::string> spread (const std::string& path, const Patch* from)
    {
        for (std::string_view left = path; from != nullptr && ! left.empty();)
        {
            const auto step = firstStep (left);
            if (from != &patch || step.name != command.name)
            {
                from = subgraphOf (from->find (step.name));
                left = step.rest;
                continue;
            }
            const auto before = path.substr (0, path.size() - left.size());
            const auto after = step.rest.empty() ? "" : '/' + std::string (step.rest);
            std::vector<std::string> all;
            for (int k = 0; k < count; ++k)
                if (step.instance < 0 || step.instance == k) all.push_back (before + names[at (k)] + after);
            if (all.empty()) done = cannot ("does not have the instance that " + quote (path) + " names");
            return all;
        }
        return { path };
    }

    std::vector<Endpoint> spread (const Endpoint& e, const Patch* from)
    {
        std::vector<Endpoint> all;
        for (auto& path : spread (e.node, from))
            all.push_back ({ std::move (path), e.port, e.index, e.component });
        return all;
    }

    void inPatch (Patch& p)
    {
        std::vector<Wire> wires;
        for (const auto& w : p.wires)
        {
            const auto starts = spread (w.from, &p), ends = spread (w.to, &p);
            const bool several = starts.size() * ends.size() > 1;
            for (const auto& from : starts)
                for (const auto& to : ends)
                {
                    auto& one = wires.emplace_back (w);
                    one.from = from;
                    one.to = to;
                    if (! several) continue;
                    one.origin = ancestryOf (w);
                    one.id = newId();
                }
        }
        p.wires = std::move (wires);

        for (auto* list : { &p.expose.inputs, &p.expose.outputs, &p.expose.params })
            for (auto& [name, end] : *list)
            {
                auto all = spread (end, &p);
                if (all.size() == 1)
                    end = std::move (all.front());
                else if (done)
                    done = cannot ("exposes all its instances together as " + quote (name) + " of the enclosing subgraph");
            }
        for (auto& n : p.nodes)
            if (const auto* inside = subgraphOf (&n); inside != nullptr && ! n.overrides.empty()) n.overrides = spreadOverrides (n.overrides, inside);
    }

    /// Keeps the order of precedence, so that all values stay the same.
    Json spreadOverrides (const Json& overrides, const Patch* inside)
    {
        auto changed = Json::object();
        bool touched = false;
        for (const auto* entry : byPrecedence (overrides))
        {
            const auto& [key, value] = *entry;
            auto e = parseOverride (key);
            if (! e)
            {
                append (changed, key, value);
                continue;
            }
            const auto begin = e->node.starts_with ('[') ? e->node.find ('/') + 1 : 0;
            const auto instance = e->node.substr (0, begin);
            e->node.erase (0, begin);
            for (auto& one : spread (*e, inside))
            {
                touched = touched || one != *e;
                one.node.insert (0, instance);
                giveOverride (changed, toText (one), value);
            }
        }
        return touched ? changed : overrides;
    }

    void inControl (Control& control)
    {
        std::vector<Control::Target> targets;
        for (const auto& target : control.to)
        {
            const auto e = parseEndpoint (target.path);
            auto all = e ? spread (*e, &graph.root) : std::vector<Endpoint> {};
            if (! e || (all.size() == 1 && all.front() == *e))
            {
                targets.push_back (target);
                continue;
            }
            for (const auto& one : all)
            {
                auto path = toText (one);
                std::erase_if (targets, [&] (const Control::Target& t) { return t.path == path; });   // a later target takes precedence
                targets.push_back ({ std::move (path), target.low, target.high });
            }
        }
        control.to = std::move (targets);
    }

    void takePlace()
    {
        std::vector<Node> instances;
        for (int k = 0; k < count; ++k)
        {
            auto& one = instances.emplace_back (node);
            one.id = newId();
            one.origin = ancestryOf (node, k);
            one.name = names[at (k)];
            one.roles = rolesOf (node, k);
            one.overrides = overridesOf (k);
            auto extra = Json::object();
            for (const auto& [key, value] : node.extra.items())
                if (key != "count") append (extra, key, value);
            one.extra = std::move (extra);
        }
        const auto place = patch.nodes.erase (std::ranges::find (patch.nodes, command.name, &Node::name));
        patch.nodes.insert (place, std::make_move_iterator (instances.begin()), std::make_move_iterator (instances.end()));
    }

    /// The overrides for one instance, including the overrides for all instances.
    Json overridesOf (int instance) const
    {
        auto own = Json::object();
        for (const auto* entry : byPrecedence (node.overrides))
        {
            const auto& [key, value] = *entry;
            const auto step = firstStep (key);
            const bool names_instance = key.starts_with ('[');
            if (names_instance && step.instance >= 0 && step.instance != instance) continue;
            giveOverride (own, names_instance ? std::string (step.rest) : key, value);
        }
        return own;
    }

    Graph& graph;
    const ExpandNode& command;
    Patch& patch;
    const Node& node;
    const int count;
    std::vector<std::string> names;   // names of the new nodes, by instance
    Result<> done;
};
}   // namespace

Message cannotExpand (const std::string& node, const std::string& why)
{
    return Message::error ("edit/cannot_expand", {}, quote (node) + " cannot be expanded: it " + why, "change that, then expand the node again");
}

Result<> separate (Graph& graph, const ExpandNode& command) { return Separate (graph, command).run(); }

}   // namespace tactus::graph
