// SPDX-License-Identifier: GPL-3.0-or-later
// What compiling, an edit, a knob and a node cost in graphs of thousands of nodes.
#include "bench.hpp"

#include <tactus/graph/history.hpp>
#include <tactus/nodes/filter/one_pole.hpp>
#include <tactus/run/engine.hpp>

#include <malloc.h>

#include <stdexcept>
#include <utility>

namespace tactus::bench
{

namespace
{
/// A large graph that runs while it is edited. Each edit removes the last wire, or restores it.
class Edited
{
public:
    explicit Edited (graph::Graph g) : history (std::move (g)), last (history.graph().root.wires.back())
    {
        engine.tick();
        knob = engine.param (history.graph().root.nodes.front().name + ".cutoff").value();
    }

    /// Edits, and submits the plan.
    void prepareTakeover()
    {
        has_last = ! has_last;
        auto command = has_last ? graph::Command (graph::AddWire { "", last }) : graph::Command (graph::RemoveWire { "", last.id });
        if (! history.perform (std::move (command), graph::Step::joined)) throw std::logic_error ("the edit was refused");
        auto compiled = compile (history.graph(), catalogue(), { .before = &engine.newest() });
        if (! compiled.plan) throw std::logic_error ("no plan");
        engine.submit (std::move (compiled.plan));
    }

    /// Takes over a submitted plan; otherwise a tick on which nothing has changed.
    void tick() { engine.tick(); }

    void turnKnob()
    {
        engine.set (knob, 200.0 + ++turns % 100);
        engine.tick();
    }

private:
    graph::History history;
    graph::Wire last;
    bool has_last = true;
    Engine engine { compile (history.graph(), catalogue()).plan };
    plan::ParamRef knob;
    int turns = 0;
};

double inUse()
{
    const auto info = mallinfo2();
    return static_cast<double> (info.uordblks + info.hblkhd);
}
}   // namespace

std::function<void (int)> compiling (int nodes, int times)
{
    return [g = shuffled (treeOfOnePoles (nodes)), times] (int) {
        for (int i = 0; i < times; ++i)
            compile (g, catalogue());
    };
}

std::vector<Pair> largeGraphs (bool quick)
{
    // A tick of 10 000 nodes takes about 100 us, so a round is one tick of each kind.
    const auto edited = std::make_shared<Edited> (shuffled (treeOfOnePoles (10000)));
    const auto tick = [edited] (int) { edited->tick(); };
    const auto knob = [edited] (int) { edited->turnKnob(); };
    return {
        { "compile10000/compile1000", compiling (10000, 1), compiling (1000, 10), 1.0, 10.0, quick ? 2 : 60 },
        { "takeover10000/tick", tick, tick, 1.0, 1.0, quick ? 4 : 400, [edited] (int) { edited->prepareTakeover(); } },
        { "knob10000/tick", knob, tick, 1.0, 1.0, quick ? 4 : 1000 },
    };
}

Memory memoryPerNode()
{
    constexpr int n = 10000;
    const auto g = chainOfOnePoles (n);
    std::vector<std::shared_ptr<void>> nodes;
    nodes.reserve (n);

    const double before = inUse();
    const auto plan = compile (g, catalogue()).plan;
    const double whole = inUse();
    for (const auto& instance : plan->instances())
        nodes.push_back (instance.node);   // keeps the nodes alive
    plan->forgetGraph();
    const double ticked = inUse();
    return { .to_tick = (ticked - before) / n - sizeof (nodes::OnePole), .to_edit = (whole - ticked) / n };
}

}   // namespace tactus::bench
