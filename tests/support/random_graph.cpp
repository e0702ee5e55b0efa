// SPDX-License-Identifier: MIT
#include "random_graph.hpp"
#include "sketch.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>

namespace tactus::test
{

namespace
{
class Generator
{
public:
    explicit Generator (std::mt19937& r) : random (r) {}

    graph::Graph make (int size)
    {
        graph::Graph g;
        g.name = "Chance";
        const int kinds = size > 12 ? below (4) : 0;
        for (int k = 0; k < kinds; ++k)
        {
            graph::Patch patch;
            fill (patch, 1 + below (size / 8), g);
            expose (patch);
            g.graphs.emplace_back ("sub" + std::to_string (k), std::move (patch));
        }
        fill (g.root, std::max (2, size - count (g)), g);
        repair (g);
        return g;
    }

    /// A node of any type, or of one of the graph's subgraphs.
    graph::Node node (std::string name, const graph::Graph& g)
    {
        graph::Node n;
        n.name = std::move (name);
        if (! g.graphs.empty() && oneIn (8))
        {
            const auto& [kind, patch] = oneOf (g.graphs);
            n.type = "graph:" + kind;
            if (oneIn (2)) multiply (n, patch);
            giveRate (n);
        }
        else
        {
            const auto& type = *std::next (catalogue().begin(), below (static_cast<int> (std::distance (catalogue().begin(), catalogue().end()))));
            n.type = type.info.id;
            if (type.bind) n.role = oneIn (2) ? "left" : "right";
            for (const auto& s : type.settings)
            {
                if (s.id == "inputs") n.settings["inputs"] = 1 + below (4);
                if (s.id == "text") n.settings["text"] = "in[0] * 0.5";
                if (s.id == "ticks") n.settings["ticks"] = 1 + below (5);
                if (s.id == "modes") n.settings["modes"] = { { { "frequency", 180.0 }, { "decay", 20.0 }, { "amplitude", 0.5 } } };
            }
            for (const auto& p : type.params)
                if (p.choices.size() > 1 && ! p.list) n.params[std::string (p.id)] = oneOf (p.choices);
        }
        n.bypass = ! n.type.starts_with ("graph:") && oneIn (20);
        return n;
    }

    std::optional<graph::Wire> wire (const graph::Node& a, const graph::Node& b, const graph::Graph& g)
    {
        const auto from = port (a, true, g), to = port (b, false, g);
        if (! from || ! to || (from->width != 0 && to->width != 0 && from->width != to->width)) return {};

        graph::Wire w;
        w.from = from->endpoint;
        w.to = to->endpoint;
        if (oneIn (6)) w.delay = 1 + below (4);
        if (oneIn (5)) w.gain = 0.25 * (1 + below (8)) - 1.0;
        w.add = oneIn (3);
        return w;
    }

private:
    std::mt19937& random;

    int below (int n) { return std::uniform_int_distribution { 0, std::max (n, 1) - 1 }(random); }
    bool oneIn (int n) { return below (n) == 0; }

    template <typename List>
    auto oneOf (List& list) -> decltype (list[0])
    {
        return list[static_cast<std::size_t> (below (static_cast<int> (list.size())))];
    }

    void giveRate (graph::Node& n)
    {
        if (oneIn (3))
        {
            n.extra["every"] = 2 + below (3);
            if (oneIn (2)) n.extra["hold"] = oneIn (2) ? "linear" : "latch";
        }
        else if (oneIn (2))
            n.extra["times"] = 2 + below (2);
    }

    static int count (const graph::Graph& g)
    {
        int n = 0;
        for (const auto& [name, patch] : g.graphs)
            n += static_cast<int> (patch.nodes.size());
        return n;
    }

    static int countOf (const graph::Node& n) { return n.extra.value ("count", 0); }

    /// Gives a node several instances that differ slightly.
    void multiply (graph::Node& n, const graph::Patch& inside)
    {
        n.extra["count"] = 1 + below (4);
        for (const auto* role : { "left", "right" })
            if (oneIn (2))
                n.roles[role] = oneIn (2) ? Json ("left") : Json (std::vector<std::string> (static_cast<std::size_t> (countOf (n)), "left"));
        if (n.roles.is_object())
            for (auto& [role, means] : n.roles.asObject())
                if (means.is_array()) means[0] = "right";
        for (const auto& m : inside.nodes)
        {
            const auto* type = catalogue().find (m.type);
            if (type == nullptr || type->params.empty() || type->problem) continue;
            const auto& row = oneOf (type->params);
            const auto key = m.name + "." + std::string (row.id);
            if (row.list || row.width != 1 || ! row.choices.empty()) continue;
            if (oneIn (3)) n.overrides["[" + std::to_string (below (countOf (n))) + "]/" + key] = row.limits.hard.clamp (0.5 * below (9));
            if (oneIn (3)) n.overrides[(oneIn (2) ? "[*]/" : "") + key] = row.limits.hard.clamp (0.3 * below (9));
        }
    }

    void fill (graph::Patch& patch, int size, const graph::Graph& g)
    {
        for (int i = 0; i < size; ++i)
            patch.nodes.push_back (node ("n" + std::to_string (i), g));
        for (int i = 0; i < 2 * size; ++i)
            addWire (patch, g);
    }

    struct Port
    {
        graph::Endpoint endpoint;
        int width;
    };

    /// The ports where a wire may start or end: the outputs, or the inputs and occasionally the params.
    template <typename List>
    const List& oneListOf (bool start, const List& outputs, const List& inputs, const List& params)
    {
        if (start) return outputs;
        return oneIn (4) && ! params.empty() ? params : inputs;
    }

    /// A random port of a node, as seen from the start or end of a wire.
    std::optional<Port> port (const graph::Node& n, bool start, const graph::Graph& g)
    {
        if (n.type.starts_with ("graph:"))
        {
            const auto& e = g.find (n.type.substr (6))->expose;
            const auto& list = oneListOf (start, e.outputs, e.inputs, e.params);
            auto path = n.name;
            if (const int count = countOf (n); count > 0 && oneIn (2))
                path += oneIn (3) ? "[*]" : "[" + std::to_string (below (count)) + "]";
            if (const auto& nodes = g.find (n.type.substr (6))->nodes; ! nodes.empty() && oneIn (4))
            {
                auto inner = port (oneOf (nodes), start, g);
                if (inner) inner->endpoint.node.insert (0, path + "/");
                return inner;
            }
            if (list.empty()) return {};
            return Port { { path, oneOf (list).first }, 0 };
        }
        const auto& type = *catalogue().find (n.type);
        const auto& rows = oneListOf (start, type.outputs, type.inputs, type.params);
        if (rows.empty()) return {};
        const auto& row = oneOf (rows);
        Port p { { n.name, std::string (row.id) }, row.width };
        if (row.list) p.endpoint.index = below (n.settings.value ("inputs", 2));
        if (row.width == 3 && oneIn (3))
        {
            p.endpoint.component = below (3);
            p.width = 1;
        }
        return p;
    }

    void addWire (graph::Patch& patch, const graph::Graph& g)
    {
        const auto& a = oneOf (patch.nodes);
        const auto& b = oneOf (patch.nodes);
        if (auto w = wire (a, b, g)) patch.wires.push_back (std::move (*w));
    }

    void expose (graph::Patch& patch)
    {
        for (const auto& n : patch.nodes)
        {
            if (n.type.starts_with ("graph:")) continue;
            const auto& type = *catalogue().find (n.type);
            const auto add = [&] (auto& list, const std::vector<PortSheet>& rows) {
                for (const auto& row : rows)
                    if (! row.list && row.choices.empty() && oneIn (2))
                        list.emplace_back (n.name + "_" + std::string (row.id), graph::Endpoint { n.name, std::string (row.id) });
            };
            add (patch.expose.inputs, type.inputs);
            add (patch.expose.outputs, type.outputs);
            add (patch.expose.params, type.params);
        }
    }

    static graph::Patch& patchOf (graph::Graph& g, const std::string& pointer)
    {
        if (pointer.starts_with ("/wires/")) return g.root;
        const auto name = pointer.substr (8, pointer.find ('/', 8) - 8);   // "/graphs/NAME/…"
        return std::ranges::find (g.graphs, name, &std::pair<std::string, graph::Patch>::first)->second;
    }

    /// Removes or repairs the parts that do not compile: adds a delay to a loop, or a gain with a unit where dimensions differ.
    void repair (graph::Graph& g)
    {
        for (;;)
        {
            const auto messages = compile (g, catalogue()).messages;
            std::set<std::pair<graph::Patch*, std::size_t>> doomed;
            bool repaired = false;
            for (const auto& m : messages)
            {
                if (m.severity != Message::Severity::error) continue;
                const auto at = m.where.rfind ("/wires/");
                if (m.id == "rate/to_the_hand")
                {
                    slowDown (g, m.where);
                    continue;
                }
                if (at == std::string::npos)
                {
                    unwire (g, m.where, doomed);
                    continue;
                }
                auto& patch = patchOf (g, m.where);
                const auto index = static_cast<std::size_t> (std::stoul (m.where.substr (at + 7)));
                repaired = true;
                if (m.id == "graph/loop")
                    patch.wires[index].delay = 1 + below (3);
                else if (m.id == "wire/add_to_input")
                    patch.wires[index].add = false;
                else if (m.id == "wire/unit" && patch.wires[index].gain.is_null() && oneIn (2))
                    patch.wires[index].gain = "0.5 " + m.remedy.substr (m.remedy.rfind (' ') + 1);   // the remedy ends with the unit
                else
                    doomed.emplace (&patch, index);
            }
            if (! hasErrors (messages)) return;
            if (doomed.empty() && ! repaired) doomLast (g, messages, doomed);
            for (auto i = doomed.rbegin(); i != doomed.rend(); ++i)
                i->first->wires.erase (i->first->wires.begin() + static_cast<std::ptrdiff_t> (i->second));
        }
    }

    /// Removes the last wire of the graph, or else of a subgraph: a clash inside a subgraph comes from a wire outside.
    static void doomLast (graph::Graph& g, const Messages& messages, std::set<std::pair<graph::Patch*, std::size_t>>& doomed)
    {
        auto* patch = &g.root;
        for (auto& [name, sub] : g.graphs)
            if (g.root.wires.empty() && ! sub.wires.empty()) patch = &sub;
        if (patch->wires.empty()) throw std::logic_error ("a graph without wires has errors:\n" + text (messages));
        doomed.emplace (patch, patch->wires.size() - 1);
    }

    /// A subgraph that returns effort to the hand must not run several times a tick: "/graphs/sub1/nodes/n3/times".
    static void slowDown (graph::Graph& g, std::string pointer)
    {
        pointer.erase (pointer.rfind ('/'));
        auto& patch = pointer.starts_with ("/graphs/") ? patchOf (g, pointer) : g.root;
        std::ranges::find (patch.nodes, pointer.substr (pointer.rfind ('/') + 1), &graph::Node::name)->extra.erase ("times");
    }

    /// Removes a wire of a node whose units clash.
    static void unwire (graph::Graph& g, const std::string& node_pointer, std::set<std::pair<graph::Patch*, std::size_t>>& doomed)
    {
        const auto name = node_pointer.substr (node_pointer.rfind ('/') + 1);
        auto& patch = node_pointer.starts_with ("/graphs/") ? patchOf (g, node_pointer) : g.root;
        for (std::size_t i = patch.wires.size(); i-- > 0;)
            if (graph::firstNameOf (patch.wires[i].to.node) == name || graph::firstNameOf (patch.wires[i].from.node) == name)
            {
                doomed.emplace (&patch, i);
                return;
            }
    }
};
}   // namespace

graph::Graph randomGraph (unsigned seed, int size)
{
    std::mt19937 random { seed };
    return Generator { random }.make (size);
}

graph::Node randomNode (std::mt19937& random, std::string name, const graph::Graph& g) { return Generator { random }.node (std::move (name), g); }

std::optional<graph::Wire> randomWire (std::mt19937& random, const graph::Node& from, const graph::Node& to, const graph::Graph& g)
{
    return Generator { random }.wire (from, to, g);
}

graph::Graph shuffled (graph::Graph g, unsigned seed)
{
    std::mt19937 random { seed };
    const auto shuffle = [&] (graph::Patch& p) {
        std::ranges::shuffle (p.nodes, random);
        std::ranges::shuffle (p.wires, random);
    };
    shuffle (g.root);
    for (auto& [name, patch] : g.graphs)
        shuffle (patch);
    return g;
}

}   // namespace tactus::test
