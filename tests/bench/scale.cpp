// SPDX-License-Identifier: MIT
// Does things whose cost must not grow with the size of the graph, so that callgrind can count (scale.py):
//
//     scale NODES
//
// Callgrind counts inside the functions called `counted_…` and dumps after each `counted`, so its n-th dump belongs to the n-th line
// printed here.

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

using namespace tactus;

extern "C"
{
    // Callgrind finds these functions by name, so they must not be inlined.
    [[gnu::noinline]] void counted_tick (Engine&) noexcept;
    [[gnu::noinline]] void counted_compile (Compiled& result, const graph::Graph&, const CompileOptions&);
    [[gnu::noinline]] void counted_load (Compiled& result, const std::string&);
    [[gnu::noinline]] void counted() noexcept;

    void counted_tick (Engine& engine) noexcept { engine.tick(); }
    void counted_compile (Compiled& result, const graph::Graph& graph, const CompileOptions& options) { result = compile (graph, catalogue(), options); }
    void counted_load (Compiled& result, const std::string& text) { result = compile (readGraph (text).graph, catalogue()); }
    void counted() noexcept { asm volatile(""); }
}

namespace
{
std::string nameOf (int node)
{
    auto digits = std::to_string (node);
    return "p" + std::string (6 - std::min<std::size_t> (6, digits.size()), '0') + digits;
}

/// A tree in which each node feeds two others, next to a wall that a hand feels.
graph::Graph tree (int n)
{
    graph::Graph g;
    const auto add = [&] (std::string name, std::string type) -> graph::Node& {
        auto& node = g.root.nodes.emplace_back();
        node.name = std::move (name);
        node.type = std::move (type);
        return node;
    };
    const auto wire = [&] (const std::string& text) { g.root.wires.push_back (*graph::parseWire (text)); };
    add ("hand", "device.position").role = "stylus";
    add ("motor", "device.force").role = "stylus";
    add ("wall", "deform.plane");
    wire ("hand.position -> wall.position");
    wire ("wall.force -> motor.force");
    for (int i = 0; i < n; ++i)
    {
        const auto name = nameOf (i);
        add (name, "filter.one_pole").params["cutoff"] = 200.0 + 10.0 * (i % 100);
        if (i > 0) wire (nameOf ((i - 1) / 2) + ".out -> " + name + ".in");
    }
    return g;
}

void done (const char* what)
{
    counted();
    std::printf ("%s\n", what);
}

std::shared_ptr<Plan> planOf (Compiled compiled)
{
    if (compiled.plan) return std::move (compiled.plan);
    for (const auto& m : compiled.messages)
        std::fprintf (stderr, "%s\n", m.text.c_str());
    std::exit (1);
}
}   // namespace

int main (int argc, char** argv)
{
    if (argc != 2) return 2;
    const int n = std::stoi (argv[1]);
    graph::History history (tree (n));
    const auto& graph = history.graph();
    const auto text = writeGraph (graph);

    Compiled loaded;
    counted_load (loaded, text);
    planOf (std::move (loaded));
    done ("load");
    Compiled compiled;
    counted_compile (compiled, graph, {});
    Engine engine { planOf (std::move (compiled)) };
    done ("compile");
    counted_tick (engine);
    counted_tick (engine);
    counted();
    std::printf ("first ticks\n");
    counted_tick (engine);
    done ("tick");

    engine.set (*engine.param (nameOf (7) + ".cutoff"), 500.0);
    counted_tick (engine);
    done ("knob");
    for (int k = 0; k < 200; ++k)
        engine.tick();

    const auto edit = [&] (graph::Command command) {
        if (! history.perform (std::move (command))) std::exit (1);
        const auto withdrawn = engine.withdraw();
        counted_compile (compiled, graph, { .before = &engine.newest(), .withdrawn = withdrawn.get() });
        auto plan = planOf (std::move (compiled));
        done ("edit");
        engine.submit (std::move (plan));
        counted_tick (engine);
        done ("takeover");
    };
    const auto last = graph.root.wires.back();
    edit (graph::RemoveWire { "", last.id });
    edit (graph::AddWire { "", last });
    graph::Node idle;
    idle.name = "idle";
    idle.type = "signal.abs";
    edit (graph::AddNode { "", idle });
    edit (graph::SetParam { "", nameOf (3), "cutoff", Json (300.0) });
}
