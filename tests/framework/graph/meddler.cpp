// SPDX-License-Identifier: MIT
#include "meddler.hpp"

#include <algorithm>

namespace tactus::test
{
namespace
{
using namespace graph;

/// Makes one edit.
class Choice
{
public:
    explicit Choice (std::mt19937_64& e) : engine (e) {}

    /// Long because it is one table: a case for each kind of edit.
    Command any (const Graph& g, int depth)
    {
        const auto patch = anyPatch (g);
        const auto* p = patch.empty() ? &g.root : g.find (patch);
        switch (upTo (depth > 0 ? 20 : 19))
        {
        case 0:
            return AddNode { patch, anyNode (g), place() };
        case 1:
            return RemoveNode { patch, nodeIn (p) };
        case 2:
            return RenameNode { patch, nodeIn (p), name() };
        case 3:
            return SetParam { patch, nodeIn (p), oneOf ({ "mu", "gain", "position", "No" }), maybe (0.5) };
        case 4:
            return SetSetting { patch, nodeIn (p), oneOf ({ "curve", "table" }), maybe (Json::array ({ 1, 2 })) };
        case 5:
            return SetNodeKey { patch, nodeIn (p), oneOf ({ "role", "type" }), maybe (oneOf ({ "stylus", "graph:sub1", "Bad" })) };
        case 6:
            return SetNodeKey { patch, nodeIn (p), oneOf ({ "count", "ui", "note", "bypass" }),
                                maybe (oneIn (2) ? Json (2) : (oneIn (2) ? Json (true) : Json::object())) };
        case 7:
            if (oneIn (2)) return SetOverride { patch, nodeIn (p), oneOf ({ "n1.mu", "[1]/n1.mu", "[*]/n2[0]/n1.x", "bad" }), maybe (1), place() };
            return SetNodeKey { patch, nodeIn (p), "overrides", maybe (Json { { "n1.mu", 1 }, { "[1]/n1.mu", 2 }, { "n2/n1.x", 3 } }) };
        case 8:
            return AddWire { patch, anyWire (p), place() };
        case 9:
            return RemoveWire { patch, wireIn (p) };
        case 10:
            return ChangeWire { patch, wireIn (p), anyWire (p) };
        case 11:
            return AddControl { anyControl (g), place() };
        case 12:
            return RemoveControl { oneOf ({ "control1", "control2" }) };
        case 13:
            return ChangeControl { oneOf ({ "control1", "control2" }), anyControl (g) };
        case 14:
        {
            if (oneIn (2)) return RemoveSubgraph { oneOf ({ "sub1", "sub2", "new" }) };
            Patch fresh;
            fresh.nodes.push_back (anyNode (g));
            return AddSubgraph { oneOf ({ "sub1", "new", "No" }), fresh, place() };
        }
        case 15:
        {
            Expose expose;
            if (oneIn (2)) expose.inputs.emplace_back (oneOf ({ "in", "No" }), Endpoint { nodeIn (p), "x", -1, -1 });
            return ChangeExpose { patch, expose };
        }
        case 16:
        {
            if (oneIn (2)) return SetDevice { oneOf ({ "stylus", "thumb" }), maybe (Json { { "driver", "sim" } }), place() };
            SetHeader header { patch };
            if (oneIn (2)) header.name = "Name";
            if (oneIn (2)) header.rate_hz = oneIn (4) ? -1.0 : 1000.0;
            if (oneIn (2)) header.ui = maybe (Json { { "zoom", 2 } }).value_or (Json());
            return header;
        }
        case 17:
            return RenameSubgraph { oneOf ({ "sub1", "sub2", "new" }), oneOf ({ "sub1", "fresh", "No" }) };
        case 18:
        {
            CollapseNodes collapse { patch, {}, oneOf ({ "group", "n1", "No" }), oneOf ({ "new", "newer", "sub1" }) };
            for (int i = 1 + upTo (2); i > 0; --i)
                if (const auto n = nodeIn (p); std::ranges::count (collapse.nodes, n) == 0) collapse.nodes.push_back (n);
            return collapse;
        }
        case 19:
            return ExpandNode { patch, nodeIn (p) };
        default:
        {
            Batch batch { "several", {} };
            for (int i = upTo (3); i > 0; --i)
                batch.commands.push_back (any (g, depth - 1));
            return batch;
        }
        }
    }

private:
    int upTo (int n) { return std::uniform_int_distribution<int> (0, n) (engine); }
    bool oneIn (int n) { return upTo (n - 1) == 0; }
    std::string oneOf (std::initializer_list<const char*> list) { return *(list.begin() + upTo (static_cast<int> (list.size()) - 1)); }
    std::optional<Json> maybe (Json value) { return oneIn (3) ? std::nullopt : std::optional (std::move (value)); }
    graph::Place place() { return oneIn (2) ? std::nullopt : graph::Place (static_cast<std::size_t> (upTo (4))); }
    std::string name() { return oneOf ({ "n1", "n2", "n3", "n7", "ghost", "fresh", "Bad Name" }); }

    std::string anyPatch (const Graph& g)
    {
        if (g.graphs.empty() || oneIn (2)) return oneIn (10) ? "nowhere" : "";
        return g.graphs[static_cast<std::size_t> (upTo (static_cast<int> (g.graphs.size()) - 1))].first;
    }

    std::string nodeIn (const Patch* p)
    {
        if (p == nullptr || p->nodes.empty() || oneIn (5)) return name();
        return p->nodes[static_cast<std::size_t> (upTo (static_cast<int> (p->nodes.size()) - 1))].name;
    }

    Id wireIn (const Patch* p)
    {
        if (p == nullptr || p->wires.empty() || oneIn (5)) return 1;
        return p->wires[static_cast<std::size_t> (upTo (static_cast<int> (p->wires.size()) - 1))].id;
    }

    graph::Node anyNode (const Graph& g)
    {
        if (! g.root.nodes.empty() && oneIn (5)) return g.root.nodes[0];   // its id is already taken
        graph::Node n;
        n.name = name();
        n.type = oneOf ({ "signal.gain", "graph:sub1" });
        if (oneIn (3)) n.params["gain"] = 2;
        return n;
    }

    Wire anyWire (const Patch* p)
    {
        Wire w;
        w.from = { nodeIn (p) + (oneIn (4) ? "/n1" : ""), oneOf ({ "out", "x", "Bad" }), -1, -1 };
        w.to = { nodeIn (p) + (oneIn (4) ? "[2]" : ""), "in", oneIn (3) ? 1 : -1, oneIn (3) ? 2 : -1 };
        if (oneIn (4)) w.gain = oneOf ({ "2 N", "many" });
        return w;
    }

    Control anyControl (const Graph& g)
    {
        Control c;
        c.id = oneOf ({ "control1", "control2", "control3", "No" });
        for (int i = upTo (2); i > 0; --i)
            c.to.push_back ({ nodeIn (&g.root) + (oneIn (3) ? "/n1" : "") + ".mu", 0, 1 });
        return c;
    }

    std::mt19937_64& engine;
};
}   // namespace

Command Meddler::any (const Graph& g) { return Choice { engine }.any (g, 2); }

}   // namespace tactus::test
