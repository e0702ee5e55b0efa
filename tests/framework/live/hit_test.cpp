// SPDX-License-Identifier: MIT
// Hits from outside: games, other programs, a user at the keyboard.

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"
#include <support/property.hpp>
#include <tactus/plan/find_hit.hpp>
#include <tactus/run/turn.hpp>

#include <catch2/catch.hpp>

#include <limits>
#include <numeric>

using namespace tactus;
using test::Sketch;

namespace
{
std::string idOf (const Result<>& result) { return result ? "" : result.error().id; }

/// The values of the first tap on each tick.
std::vector<double> ticked (Engine& engine, int ticks)
{
    std::vector<double> values;
    for (int k = 0; k < ticks; ++k)
    {
        engine.tick();
        values.push_back (*engine.plan().taps()[0].value);
    }
    return values;
}

Sketch bell() { return Sketch {}.node ("ring", "vibration.modal"); }

const CompileOptions watched { .records = { "ring.hit" } };

/// A bell inside a subgraph with its own rate or several instances.
Sketch inside (Json extra)
{
    Sketch s;
    auto& part = s.subgraph ("part");
    s.add (part, "ring", "vibration.modal");
    part.expose = { { { "strike", { "ring", "hit" } } }, { { "value", { "ring", "value" } } }, {} };
    s.node ("sec", "graph:part");
    s.graph.root.nodes.back().extra = std::move (extra);
    return s;
}
}   // namespace

TEST_CASE ("a hit from outside is at its input for one tick, whatever value the wires carry", "[live][hit]")
{
    Engine engine { bell().compile (watched).plan };
    ticked (engine, 3);
    CHECK (idOf (strike (engine, "ring.hit", 0.5)) == "");
    CHECK (ticked (engine, 4) == std::vector<double> { 0.5, 0.0, 0.0, 0.0 });
    REQUIRE (strike (engine, "ring.hit", 0.5));
    REQUIRE (strike (engine, "ring.hit", 0.25));   // before the next tick
    CHECK (ticked (engine, 2) == std::vector<double> { 0.75, 0.0 });

    Engine wired { bell().node ("one", "signal.constant", { { "value", 2.0 } }).wire ("one.out -> ring.hit").compile (watched).plan };
    CHECK (ticked (wired, 1) == std::vector<double> { 2.0 });
    REQUIRE (strike (wired, "ring.hit", 0.5));
    CHECK (ticked (wired, 2) == std::vector<double> { 2.5, 2.0 });

    Engine held { Sketch {}
                      .node ("one", "signal.constant", { { "value", 3.0 } })
                      .node ("hold", "signal.sample_hold")
                      .wire ("one.out -> hold.in")
                      .compile ({ .records = { "hold.out" } })
                      .plan };   // signal.sample_hold has no parameters
    CHECK (ticked (held, 1) == std::vector<double> { 0.0 });
    REQUIRE (strike (held, "hold.hit", 1.0));
    CHECK (ticked (held, 2) == std::vector<double> { 3.0, 3.0 });
}

TEST_CASE ("a hit sounds once in a section that runs only on some ticks, or several times per tick", "[live][hit]")
{
    const auto total = [] (Json extra, int tick) {
        Engine engine { inside (std::move (extra)).compile ({ .records = { "sec/ring.hit", "sec/ring.value" } }).plan };
        ticked (engine, tick);
        REQUIRE (idOf (strike (engine, "sec/ring.hit", 0.5)) == "");
        double heard = 0.0;
        for (int k = 0; k < 40; ++k)
        {
            engine.tick();
            const auto& tap = engine.plan().taps()[0];
            const bool runs = engine.plan().rests().empty() || engine.plan().nextTick() % engine.plan().rests().back() == 1;
            for (int i = 0; runs && i < tap.per_tick; ++i)
                heard += tap.samples ? tap.samples[i] : *tap.value;
        }
        return heard;
    };
    for (int tick = 0; tick < 9; ++tick)
    {
        CHECK (total ({ { "every", 4 } }, tick) == 0.5);
        CHECK (total ({ { "times", 4 } }, tick) == 0.5);
        CHECK (total (Json::object(), tick) == 0.5);
    }
}

TEST_CASE ("an edit neither loses nor doubles a hit", "[live][hit]")
{
    const auto sketch = bell();
    test::Live live { sketch.graph, catalogue(), watched, sketch.compile (watched).plan };
    auto& engine = live.engine();
    ticked (engine, 2);
    test::property ("before and after any edit", [&] {
        double asked = 0.0, heard = 0.0;
        for (int k = 0; k < 20; ++k)
        {
            const auto step = [&] {
                if (*rc::gen::inRange (0, 3) > 0) return;
                RC_ASSERT (strike (engine, "ring.hit", 0.25));
                asked += 0.25;
            };
            step();
            if (*rc::gen::inRange (0, 3) == 0)
                live.perform (graph::SetParam { .patch = {}, .node = "ring", .param = "gain", .value = *rc::gen::inRange (1, 9) });
            if (*rc::gen::inRange (0, 5) == 0)
                live.perform (
                    graph::AddNode { .patch = {}, .node = Sketch::makeNode ("more" + std::to_string (live.graph().root.nodes.size()), "signal.abs") });
            step();
            engine.tick();
            heard += *engine.plan().taps()[0].value;
        }
        RC_ASSERT (heard == asked);
    });
}

TEST_CASE ("exposed hit inputs are triggered by their exposed names, and all instances by the common name", "[live][hit]")
{
    Engine engine { inside ({ { "count", 3 } }).compile ({ .records = { "sec[0]/ring.hit", "sec[1]/ring.hit", "sec[2]/ring.hit" } }).plan };
    const auto after = [&] (const char* name) {
        CHECK (idOf (strike (engine, name, 1.0)) == "");
        engine.tick();
        std::string seen;
        for (const auto& tap : engine.plan().taps())
            seen += *tap.value == 1.0 ? 'x' : '.';
        return seen;
    };
    CHECK (after ("sec[1]/ring.hit") == ".x.");
    CHECK (after ("sec/ring.hit") == "xxx");
    CHECK (after ("sec[2].strike") == "..x");
    CHECK (after ("sec.strike") == "xxx");

    const auto& plan = engine.newest();
    for (std::size_t i = 0; i < plan.instances().size(); ++i)
        if (plan.instances()[i].is_struck)
        {
            const auto found = plan::findHits (plan, plan::nameOfHit (plan, i, 0));
            REQUIRE (found->size() == 1);
            CHECK ((*found)[0].knobs == plan.instances()[i].knobs);
        }
}

TEST_CASE ("an invalid hit is refused and has no effect", "[live][hit]")
{
    auto sketch = bell().node ("amp", "signal.gain").node ("mute", "vibration.modal");
    sketch.graph.root.nodes.back().extra = { { "bypass", true } };
    Engine engine { sketch.compile (watched).plan };
    for (const double speed :
         { 0.0, -0.5, 1001.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
        CHECK (idOf (strike (engine, "ring.hit", speed)) == "hit/value");
    CHECK (idOf (strike (engine, "rings.hit", 1.0)) == "port/unknown_node");
    CHECK (idOf (strike (engine, "ring.gain", 1.0)) == "hit/unknown");
    CHECK (idOf (strike (engine, "amp.in", 1.0)) == "hit/unknown");
    CHECK (idOf (strike (engine, "ring.hit.x", 1.0)) == "hit/unknown");
    CHECK (idOf (strike (engine, "ring", 1.0)) == "hit/name");
    CHECK (strike (engine, "rings.hit", 1.0).error().remedy.find ("ring.hit") != std::string::npos);
    CHECK (ticked (engine, 2) == std::vector<double> { 0.0, 0.0 });

    const auto ring = engine.hits ("ring.hit")->front();
    engine.strike (ring, std::numeric_limits<double>::quiet_NaN());
    engine.strike (ring, -1.0);
    CHECK (ticked (engine, 2) == std::vector<double> { 0.0, 0.0 });
    engine.strike (ring, 1.0);
    CHECK (ticked (engine, 2) == std::vector<double> { 1.0, 0.0 });
}

TEST_CASE ("hits cause no allocation and no lock in the tick", "[live][hit]")
{
    Engine engine { bell().compile (watched).plan };
    const auto ring = engine.hits ("ring.hit")->front();
    engine.tick();
    NoAllocation watch;
    for (int k = 0; k < 100; ++k)
    {
        engine.strike (ring, 0.1);
        engine.tick();
    }
    CHECK (watch.allocations() == 0);
    CHECK (watch.locks() == 0);
}
