// SPDX-License-Identifier: GPL-3.0-or-later
// Times painting and editing of large graphs. Prints the times without checking them, because machines are shared.
#include "host/app/support/canvas_rig.hpp"

#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <iostream>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
graph::Graph chainOf (int nodes)
{
    graph::Graph g;
    for (int i = 0; i < nodes; ++i)
    {
        graph::Node n;
        n.name = "n" + std::to_string (i);
        static constexpr const char* types[] { "signal.slew", "signal.abs", "signal.gain" };
        n.type = types[i % 3];
        g.root.nodes.push_back (n);
        if (i == 0) continue;
        graph::Wire w;
        w.from = { "n" + std::to_string (i - 1), "out" };
        w.to = { n.name, "in" };
        g.root.wires.push_back (w);
    }
    return g;
}

double milliseconds (const std::function<void()>& work)
{
    constexpr int times = 10;
    const tactus::test::Stopwatch watch;
    for (int i = 0; i < times; ++i)
        work();
    return 1e3 * watch.s() / times;
}
}   // namespace

TEST_CASE ("painting, panning and editing times with 200 and 1000 nodes", "[app][canvas][effort]")
{
    for (const int nodes : { 200, 1000 })
    {
        CanvasRig rig { chainOf (nodes) };
        const auto paint = [&] { rig.canvas->createComponentSnapshot (rig.canvas->getLocalBounds()); };
        paint();   // creates the glyphs
        const double all = milliseconds (paint);
        rig.canvas->commands().zoomBy (1.0f / rig.canvas->view().zoom);
        const double near = milliseconds ([&] {
            rig.canvas->view().origin.x += 7.0f;
            paint();
        });
        const double edit = milliseconds ([&] { rig.document.perform (graph::SetParam { {}, "n2", "gain", Json (0.5) }); });
        std::cout << nodes << " nodes: " << all << " ms to draw all, " << near << " ms per frame to pan at 100 %, " << edit << " ms to show an edit\n";
        CHECK (rig.canvas->scene().nodes().size() == static_cast<std::size_t> (nodes));
    }
}
