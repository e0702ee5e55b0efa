// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <host/app/run/port_feed.hpp>
#include <host/app/run/views/live_feed.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using tactus::test::Sketch;

namespace
{
/// Ticks a graph without a device, with a feed that watches some ports of it.
class FedRun
{
public:
    PortFeed feed;

    FedRun (graph::Graph g, std::vector<std::string> ports) : graph (std::move (g))
    {
        graph.rate_hz = 1200.0;
        feed.portsNow = [ports = std::move (ports)] { return ports; };
        next();
    }

    void next()
    {
        const auto compiled = compile (graph, catalogue(), { .records = feed.ports() });
        if (! compiled.plan) throw std::runtime_error ("the graph does not compile");
        plan = compiled.plan;
        feed.planComes (*plan);
    }

    void tick (int times)
    {
        for (int i = 0; i < times; ++i, ++number)
        {
            plan->beginTick (number);
            plan->tick();
            feed.after (*plan, number, false);
            if (number % 100 == 99) feed.refresh();
        }
        feed.refresh();
    }

private:
    graph::Graph graph;
    std::shared_ptr<Plan> plan;
    std::uint64_t number = 0;
};

Sketch wobble()
{
    return Sketch {}.node ("wave", "signal.lfo", { { "frequency", 2.0 }, { "amplitude", 3.0 } }).node ("rest", "signal.constant", { { "value", 0.0 } });
}
}   // namespace

TEST_CASE ("a feed has the latest value of a port, and how much it carries", "[app][ports]")
{
    FedRun run (wobble().graph, { "wave.out", "rest.out" });
    CHECK_FALSE (run.feed.of ("wave.out"));
    run.tick (1200);
    const auto reading = run.feed.of ("wave.out");
    REQUIRE (reading);
    REQUIRE (reading->values.size() == 1);
    CHECK (std::abs (reading->values[0]) <= 3.0);
    CHECK (run.feed.level ("wave.out") > 0.5);
    CHECK (run.feed.level ("rest.out") == 0.0);
    CHECK_FALSE (run.feed.of ("no.such"));
    CHECK (run.feed.level ("no.such") == 0.0);
    run.feed.clear();
    CHECK_FALSE (run.feed.of ("wave.out"));
}

TEST_CASE ("a course misses no tick, however rarely values are taken", "[app][ports]")
{
    // A square wave of 300 Hz at 1200 Hz: two ticks up, two ticks down. A frame is ten ticks.
    Sketch sketch;
    sketch.node ("wave", "signal.lfo", { { "frequency", 300.0 }, { "amplitude", 2.0 }, { "shape", "square" } });
    FedRun run (sketch.graph, { "wave.out" });
    run.feed.follow ("wave.out");
    run.tick (600);
    REQUIRE (run.feed.course().size() > 30);
    CHECK (run.feed.columnsPerSecond() == Approx (120.0));
    for (const auto& column : run.feed.course())
    {
        CHECK (column.low[0] == Approx (-2.0));
        CHECK (column.high[0] == Approx (2.0));
    }
    run.feed.follow ({});
    run.tick (100);
    CHECK (run.feed.course().empty());
    run.feed.follow ("wave.out");
    run.tick (60 * 1200);
    CHECK (run.feed.course().size() == PortFeed::columns);
}

TEST_CASE ("a feed that wants no port takes no frames", "[app][ports]")
{
    FedRun run (wobble().graph, {});
    run.tick (600);
    CHECK_FALSE (run.feed.of ("wave.out"));
    CHECK (run.feed.course().empty());
}

TEST_CASE ("a feed continues over an edit, and asks for a plan when other ports are wanted without one", "[app][ports]")
{
    FedRun run (wobble().graph, { "wave.out" });
    run.feed.follow ("wave.out");
    run.tick (600);
    const auto before = run.feed.course().size();
    run.next();
    run.tick (600);
    CHECK (run.feed.course().size() > before);

    int asked = 0;
    run.feed.onWanted = [&] { ++asked; };
    run.feed.refresh();
    CHECK (asked == 0);
    run.feed.portsNow = [] { return std::vector<std::string> { "rest.out" }; };
    run.feed.refresh();
    run.feed.refresh();
    CHECK (asked == 1);
    run.next();
    run.tick (120);
    CHECK (run.feed.of ("rest.out"));
    CHECK_FALSE (run.feed.of ("wave.out"));
}

TEST_CASE ("a feed has the three components of a vector, and one of them alone", "[app][ports]")
{
    Sketch sketch;
    sketch.node ("wave", "signal.lfo").node ("all", "vector.join").wire ("wave.out -> all.y");
    FedRun run (sketch.graph, { "all.out", "all.out.y" });
    run.feed.follow ("all.out");
    run.tick (600);
    REQUIRE (run.feed.of ("all.out"));
    CHECK (run.feed.of ("all.out")->values.size() == 3);
    REQUIRE (run.feed.of ("all.out.y"));
    CHECK (run.feed.of ("all.out.y")->values.size() == 1);
    const auto& column = run.feed.course().back();
    CHECK (column.low[0] == 0.0);
    CHECK (column.high[1] > column.low[1]);
}

TEST_CASE ("a canvas wants the ports where its wires begin, also those of an edit that it does not show yet", "[app][ports]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun live_run (rig.document, catalogue());
    LiveFeed live (*rig.canvas, live_run);
    auto ports = live_run.portFeed().ports();
    CHECK (std::ranges::count (ports, "hand.position") == 1);
    CHECK (std::ranges::count (ports, "board.resistance") == 1);
    CHECK (std::ranges::count (ports, "board.stored_energy") == 0);
    rig.document.perform (graph::AddWire { {}, *graph::parseWire ("board.stored_energy -> motor.force.x") });
    ports = live_run.portFeed().ports();
    CHECK (std::ranges::count (ports, "board.stored_energy") == 1);
}

namespace
{
/// Refreshes the canvas while a graph runs, until the condition holds.
template <typename F>
bool until (LiveRun& live_run, LiveFeed& live, F&& isSo)
{
    return tactus::test::eventually (std::chrono::milliseconds (2), [&] {
        live_run.poll();
        live.refresh();
        return isSo();
    });
}
}   // namespace

TEST_CASE ("the wires of a port that has very many show only whether they carry something", "[app][ports]")
{
    auto graph = CanvasRig::preset ("dry_wood");
    constexpr int more = 101;
    for (int i = 0; i < more; ++i)
    {
        graph::Node node;
        node.name = "more" + std::to_string (i);
        node.type = "deform.plane";
        graph.root.nodes.push_back (node);
        graph.root.wires.push_back (*graph::parseWire ("hand.position -> " + node.name + ".position"));
    }
    CanvasRig rig { std::move (graph) };
    LiveRun live_run (rig.document, catalogue());
    LiveFeed live (*rig.canvas, live_run);
    const auto levelOf = [&] (const std::string& text) {
        const auto& levels = rig.canvas->highlighted().live.levels;
        const auto wire = std::ranges::find (rig.canvas->scene().wires(), text, &SceneWire::text);
        const auto found = levels.find (wire->id);
        return found == levels.end() ? 0 : found->second;
    };
    int most = 0;
    live_run.start ({});
    REQUIRE (until (live_run, live, [&] {
        most = std::max (most, levelOf ("hand.position -> more7.position"));
        return levelOf ("drag.force -> motor.force") > 1 && most > 0;
    }));
    CHECK (most == 1);
}

TEST_CASE ("while a graph runs, the card of a port appears when the pointer rests on it, and wires glow", "[app][ports]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun live_run (rig.document, catalogue());
    LiveFeed live (*rig.canvas, live_run);
    const auto card = [&] { return rig.canvas->highlighted().live.card; };
    rig.hand().move (rig.port ("drag", Role::output, "force"));
    for (int i = 0; i < 2 * LiveFeed::rests_for; ++i)
        live.refresh();
    CHECK_FALSE (card());   // nothing runs

    live_run.start ({});
    REQUIRE (until (live_run, live, [&] { return card() && card()->course->size() > 2; }));
    CHECK (card()->title == "drag.force");
    CHECK (card()->values.size() == 3);
    CHECK (card()->quantity == Quantity::force);
    CHECK (card()->where.side == PointedPort::Side::right);
    CHECK (until (live_run, live, [&] { return ! rig.canvas->highlighted().live.levels.empty(); }));

    rig.hand().move (rig.middleOf ("touch.gain -> grain_felt.gain"));
    for (int i = 1; i < LiveFeed::rests_for; ++i)
    {
        live.refresh();
        CHECK_FALSE (card());
    }
    REQUIRE (until (live_run, live, [&] { return card().has_value(); }));
    CHECK (card()->title == "touch.gain");
    CHECK (card()->values.size() == 1);

    rig.hand().move (rig.port ("board", Role::output, "stored_energy"));   // no wire begins there
    CHECK (until (live_run, live, [&] { return card() && card()->title == "board.stored_energy"; }));

    rig.hand().move (rig.nowhere());
    live.refresh();
    CHECK_FALSE (card());
    live_run.letGo();
    live.refresh();
    CHECK (rig.canvas->highlighted().live.levels.empty());
}

TEST_CASE ("a port is pointed at by its label, a choice and an unwired param are not", "[app][ports]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto pointed = [&] (juce::Point<float> at) {
        rig.hand().move (at);
        return rig.canvas->pointed().port;
    };
    const auto& drag = rig.node ("drag");
    const auto* force = drag.box.find (Role::output, "force");
    CHECK (pointed (rig.canvas->view().toPixels (drag.at + force->row.getCentre())) == "drag.force");
    CHECK (pointed (rig.value ("drag", "d_max")).empty());
    CHECK (pointed (rig.title ("drag")).empty());
    CHECK (pointed (rig.port ("drag", Role::input, "position")) == "drag.position");
    rig.hand().press (rig.title ("drag"));
    CHECK (rig.canvas->pointed().port.empty());
    rig.hand().release (rig.title ("drag"));
}
