// SPDX-License-Identifier: MIT
#include "wild_graph.hpp"

#include <limits>
#include <random>

namespace tactus::test
{
namespace
{
using namespace graph;

std::string numbered (std::string name, int i) { return name.append (std::to_string (i)); }

class Dice
{
public:
    explicit Dice (std::uint64_t seed) : engine (seed) {}

    int upTo (int n) { return std::uniform_int_distribution<int> (0, n) (engine); }
    bool oneIn (int n) { return upTo (n - 1) == 0; }

    template <typename T, std::size_t n>
    T oneOf (const T (&list)[n])
    {
        return list[static_cast<std::size_t> (upTo (static_cast<int> (n) - 1))];
    }

    std::string text()
    {
        static const char* const parts[] = { "", "a", "Holz", "木目", "grain é", "😀",
                                             "\"quoted\"", "\\", "\n\t", "/~", "\x01", "a long text that makes a line too long to fit, " };
        std::string result;
        for (int i = upTo (3); i > 0; --i)
            result += oneOf (parts);
        return result;
    }

    Json number()
    {
        static const double edges[] = {
            0.0, -0.0, 1.0, 0.1, 1e-5, 0.0001, 1e15, 1e16, 1e22, 1.7976931348623157e308, 5e-324, 2.2250738585072014e-308, 0.30000000000000004, -123456.789
        };
        switch (upTo (3))
        {
        case 0:
            return upTo (10000) - 5000;
        case 1:
            return oneOf (edges);
        case 2:
            return oneIn (2) ? Json (std::numeric_limits<std::uint64_t>::max()) : Json (std::numeric_limits<std::int64_t>::min());
        default:
            return std::uniform_real_distribution<double> (-10.0, 10.0) (engine);
        }
    }

    Json value (int depth = 3)
    {
        switch (upTo (depth > 0 ? 6 : 3))
        {
        case 0:
            return text();
        case 1:
            return oneIn (2);
        case 2:
            return oneIn (4) ? Json() : Json ("0.4 mm");
        case 4:
        {
            auto list = Json::array();
            const bool numbers = oneIn (2);
            for (int i = upTo (numbers ? 40 : 4); i > 0; --i)
                list.push_back (numbers ? number() : value (depth - 1));
            return list;
        }
        case 5:
            return object ({ "x", "nodes", "wires", "grün", "", "a/b~c", "ui" }, depth - 1);
        default:
            return number();
        }
    }

    Json object (std::initializer_list<const char*> keys, int depth = 2)
    {
        auto result = Json::object();
        for (const auto* key : keys)
            if (oneIn (3)) result[key] = value (depth);
        return result;
    }

    Json extra()
    {
        auto result = oneIn (3) ? object ({ "zzz_note", "Bemerkung", "ключ" }) : Json::object();
        if (oneIn (4)) result["ui"] = object ({ "at", "colour" });
        return result;
    }

private:
    std::mt19937_64 engine;
};

class Maker
{
public:
    explicit Maker (std::uint64_t seed) : dice (seed) {}

    Graph graph()
    {
        Graph g;
        g.name = dice.text();
        g.about = dice.text();
        for (int i = dice.upTo (3); i > 0; --i)
            g.tags.push_back (dice.text());
        g.rate_hz = dice.oneOf ({ 4000.0, 1000.5, 1e-3, 48000.0, 1e20 });
        if (dice.oneIn (2)) g.devices.emplace_back ("stylus", dice.object ({ "driver", "mass", "hand" }));
        for (int i = dice.upTo (2); i > 0; --i)
            g.graphs.emplace_back (numbered ("sub", i), Patch {});
        for (auto& [name, patch] : g.graphs)
            fill (g, patch, true);
        fill (g, g.root, dice.oneIn (4));
        for (int i = dice.upTo (2); i > 0; --i)
            g.controls.push_back (control (g, i));
        g.extra = dice.extra();
        return g;
    }

private:
    void fill (const Graph& g, Patch& patch, bool expose)
    {
        for (int i = dice.upTo (5); i > 0; --i)
            patch.nodes.push_back (node (g, numbered ("n", i)));
        if (! patch.nodes.empty())
        {
            for (int i = dice.upTo (6); i > 0; --i)
                patch.wires.push_back (wire (patch));
            const auto show = [&] (auto& list, const char* name) {
                for (int i = dice.upTo (2); i > 0; --i)
                    list.emplace_back (numbered (name, i), end (patch));
            };
            if (expose)
            {
                show (patch.expose.inputs, "in");
                show (patch.expose.outputs, "out");
                show (patch.expose.params, "param");
            }
        }
        if (&patch != &g.root) patch.extra = dice.extra();
    }

    graph::Node node (const Graph& g, std::string name)
    {
        graph::Node n;
        n.name = std::move (name);
        n.type = ! g.graphs.empty() && dice.oneIn (2) ? "graph:" + g.graphs[0].first
                                                      : dice.oneOf ({ "signal.gain", "friction.elasto_plastic", "unbekannt 型" });
        if (dice.oneIn (4)) n.role = "stylus";
        n.params = dice.object ({ "mu", "gain", "position" });
        n.settings = dice.object ({ "curve", "table" });
        if (dice.oneIn (5)) n.roles = Json { { "tip", Json::array ({ "thumb", "index" }) }, { "base", "palm" } };
        if (dice.oneIn (5)) n.overrides = dice.object ({ "drag.mu", "[3]/drag.mu", "[*]/n1.mu", "[0]/n1[2]/b.c", "a/b.c" });
        n.bypass = dice.oneIn (5);
        n.extra = dice.extra();
        if (dice.oneIn (5)) n.extra["count"] = 1 + dice.upTo (5);
        if (dice.oneIn (5)) n.extra[dice.oneIn (2) ? "every" : "times"] = 1 + dice.upTo (5);
        if (dice.oneIn (5)) n.extra["hold"] = dice.oneOf ({ "latch", "linear" });
        return n;
    }

    Endpoint end (const Patch& patch)
    {
        const auto& n = patch.nodes[static_cast<std::size_t> (dice.upTo (static_cast<int> (patch.nodes.size()) - 1))];
        Endpoint e;
        e.node = n.name + (dice.oneIn (6) ? dice.oneOf ({ "[2]", "[*]" }) : "") + (n.type.starts_with ("graph:") && dice.oneIn (2) ? "/n1" : "");
        e.port = dice.oneOf ({ "position", "force", "in", "x" });
        if (dice.oneIn (4)) e.index = dice.upTo (3);
        if (dice.oneIn (4)) e.component = dice.upTo (2);
        return e;
    }

    Wire wire (const Patch& patch)
    {
        Wire w;
        w.from = end (patch);
        w.to = end (patch);
        if (dice.oneIn (4)) w.delay = 1 + dice.upTo (3);
        w.add = dice.oneIn (4);
        if (dice.oneIn (4)) w.gain = dice.oneIn (2) ? Json ("1e-4 m/N") : dice.number();
        if (dice.oneIn (4)) w.enabled = dice.oneIn (2);
        if (dice.oneIn (4)) w.extra = dice.extra();
        return w;
    }

    Control control (const Graph& g, int i)
    {
        Control c;
        c.id = numbered ("control", i);
        c.name = dice.text();
        c.value = dice.oneOf ({ 0.0, 0.5, 1.0, 0.1 });
        for (const auto& n : g.root.nodes)
            if (dice.oneIn (2)) c.to.push_back ({ n.name + (n.type.starts_with ("graph:") && dice.oneIn (2) ? "/n1.mu" : ".mu"), dice.number(), "0.4 mm" });
        c.extra = dice.extra();
        return c;
    }

    Dice dice;
};
}   // namespace

Graph wildGraph (std::uint64_t seed) { return Maker (seed).graph(); }

}   // namespace tactus::test
