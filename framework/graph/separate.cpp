// SPDX-License-Identifier: MIT
#include "separate.hpp"

#include "instances.hpp"
#include "overrides.hpp"
#include "text.hpp"

#include <framework/file/json_text.hpp>
#include <framework/in_quotes.hpp>

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

    std::optional<Message> run()
    {
        if (count == 0) return cannot ("has a `count` that is no whole number from 1 on");
        if (node.roles.is_object() && ! std::ranges::all_of (node.roles, [&] (const Json& outer)
                                                             { return ! outer.is_array() || outer.size() == static_cast<std::size_t> (count); }))
            return cannot ("gives roles to another number of instances than it has");

        chooseNames();
        inPatch (graph.root);
        for (auto& [name, p] : graph.graphs)
            inPatch (p);
        for (auto& control : graph.controls)
            inControl (control);
        if (! problem) takePlace();
        return std::move (problem);
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

    const Patch* subgraphOf (const Node* n) const { return n != nullptr && n->type.starts_with ("graph:") ? graph.find (std::string_view (n->type).substr (6)) : nullptr; }

    /// What a path from a patch on becomes: several where it means all instances.
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
                if (step.instance < 0 || step.instance == k) all.push_back (before + names[static_cast<std::size_t> (k)] + after);
            if (all.empty()) problem = cannot ("is asked for an instance that it does not have, in " + inQuotes (path));
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
                else if (! problem)
                    problem = cannot ("shows all its instances at once as " + inQuotes (name) + " of the subgraph it is in");
            }
        for (auto& n : p.nodes)
            if (const auto* inside = subgraphOf (&n); inside != nullptr && ! n.overrides.empty()) n.overrides = spreadOverrides (n.overrides, inside);
    }

    /// In order of precedence, so that what held before still holds.
    Json spreadOverrides (const Json& overrides, const Patch* inside)
    {
        auto changed = Json::object();
        bool touched = false;
        for (const auto* entry : byPrecedence (overrides))
        {
            const auto& [key, value] = *entry;
            auto parsed = parseOverride (key);
            auto* e = std::get_if<Endpoint> (&parsed);
            if (e == nullptr)
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
            const auto parsed = parseEndpoint (target.path);
            const auto* e = std::get_if<Endpoint> (&parsed);
            auto all = e != nullptr ? spread (*e, &graph.root) : std::vector<Endpoint> {};
            if (e == nullptr || (all.size() == 1 && all.front() == *e))
            {
                targets.push_back (target);
                continue;
            }
            for (const auto& one : all)
            {
                auto path = toText (one);
                std::erase_if (targets, [&] (const Control::Target& t)
                               { return t.path == path; });   // a later one holds
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
            one.name = names[static_cast<std::size_t> (k)];
            one.roles = rolesOf (node, k);
            one.overrides = overridesOf (k);
            auto extra = Json::object();
            for (const auto& [key, value] : node.extra.items())
                if (key != "count") append (extra, key, value);
            one.extra = std::move (extra);
        }
        const auto at = patch.nodes.erase (std::ranges::find (patch.nodes, command.name, &Node::name));
        patch.nodes.insert (at, std::make_move_iterator (instances.begin()), std::make_move_iterator (instances.end()));
    }

    /// What is said of one instance, or of all.
    Json overridesOf (int instance) const
    {
        auto own = Json::object();
        for (const auto* entry : byPrecedence (node.overrides))
        {
            const auto& [key, value] = *entry;
            const auto step = firstStep (key);
            const bool says_instance = key.starts_with ('[');
            if (says_instance && step.instance >= 0 && step.instance != instance) continue;
            giveOverride (own, says_instance ? std::string (step.rest) : key, value);
        }
        return own;
    }

    Graph& graph;
    const ExpandNode& command;
    Patch& patch;
    const Node& node;
    const int count;
    std::vector<std::string> names;   // what the instances become
    std::optional<Message> problem;
};
}   // namespace

Message cannotExpand (const std::string& node, const std::string& why)
{
    Message m;
    m.id = "edit/cannot_expand";
    m.text = inQuotes (node) + " " + why;
    m.remedy = "change that first";
    return m;
}

std::optional<Message> separate (Graph& graph, const ExpandNode& command) { return Separate (graph, command).run(); }

}   // namespace tactus::graph
