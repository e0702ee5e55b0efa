// SPDX-License-Identifier: MIT
// The calls to a journal, which make a run repeatable.

#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"
#include <support/property.hpp>
#include <tactus/graph/ids.hpp>
#include <tactus/plan/find_param.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using test::Sketch;

namespace
{
/// Records the calls as text.
struct Notes final : Journal
{
    void tookOver (const Plan& plan) noexcept override { add ("plan " + std::to_string (plan.serial())); }
    void tightened (std::size_t role, const GuardLimits& limits) noexcept override
    {
        add ("tighten " + std::to_string (role) + " " + std::to_string (limits.max_force));
    }
    void turned (std::size_t instance, std::size_t knob, double target) noexcept override
    {
        add ("turn " + std::to_string (instance) + " " + std::to_string (knob) + " " + std::to_string (target));
    }
    void outdone (std::size_t instance, std::size_t knob) noexcept override { add ("outdone " + std::to_string (instance) + " " + std::to_string (knob)); }
    void struck (std::size_t instance, std::size_t input, double speed) noexcept override
    {
        add ("hit " + std::to_string (instance) + " " + std::to_string (input) + " " + std::to_string (speed));
    }
    void late (std::uint64_t question) noexcept override { add ("late " + std::to_string (question)); }
    void halted() noexcept override { add ("halt"); }
    void passed (double s) noexcept override { add ("passed " + std::to_string (s)); }
    void resumed() noexcept override { add ("resume"); }
    void emergency() noexcept override { add ("emergency"); }
    void rearmed() noexcept override { add ("rearm"); }
    void ticked (const Plan&) noexcept override { add ("tick"); }

    void add (std::string what) { all.push_back (std::move (what)); }
    std::vector<std::string> taken() { return std::exchange (all, {}); }

    std::vector<std::string> all;
};
}   // namespace

TEST_CASE ("a journal gets each event on the tick on which it takes effect", "[live]")
{
    const auto sketch = Sketch {}.node ("one", "signal.constant").node ("amp", "signal.gain").wire ("one.out -> amp.in");
    test::Live live { sketch.graph, catalogue(), {}, sketch.compile().plan };
    auto& engine = live.engine();
    Notes notes;
    engine.report (notes);
    const auto plan = [&] { return "plan " + std::to_string (engine.newest().serial()); };
    CHECK (notes.taken() == std::vector<std::string> { plan() });

    REQUIRE (live.set ("amp.gain", 2.0));
    REQUIRE (live.set ("amp.gain", 3.0));   // only the last value before the tick counts
    CHECK (notes.taken().empty());
    engine.tick();
    CHECK (notes.taken() == std::vector<std::string> { "turn 1 0 3.000000", "tick" });
    engine.tick();
    CHECK (notes.taken() == std::vector<std::string> { "tick" });

    const auto before = engine.newest().serial();
    live.perform (graph::AddNode { .patch = {}, .node = Sketch::makeNode ("more", "signal.abs") });
    CHECK (engine.newest().serial() > before);
    REQUIRE (live.set ("one.value", 7.0));
    engine.tick();
    CHECK (notes.taken() == std::vector<std::string> { plan(), "turn 0 0 7.000000", "tick" });
    engine.halt();
    engine.tick();
    CHECK (notes.taken() == std::vector<std::string> { "halt", "tick" });
    engine.resume();
    CHECK (notes.taken() == std::vector<std::string> { "resume" });

    engine.emergencyStop();
    CHECK (notes.taken().empty());
    engine.tick();
    engine.emergencyStop();   // pressing it again has no effect
    engine.tick();
    CHECK (notes.taken() == std::vector<std::string> { "emergency", "tick", "tick" });
    engine.rearm();
    engine.emergencyStop();
    engine.tick();
    engine.rearm();
    engine.tick();
    CHECK (notes.taken() == std::vector<std::string> { "rearm", "emergency", "tick", "rearm", "tick" });
}

TEST_CASE ("a journal is notified when a turn takes precedence over an earlier edit", "[live]")
{
    auto sketch = Sketch {}.node ("amp", "signal.gain");
    Engine engine { sketch.compile().plan };
    engine.tick();
    sketch.graph.root.nodes[0].params["gain"] = 5.0;
    const auto edited = sketch.compile ({ .before = &engine.newest() }).plan;
    engine.set (*engine.param ("amp.gain"), 2.0);
    engine.tick();
    Notes notes;
    engine.report (notes);
    notes.taken();
    engine.submit (edited);
    engine.tick();
    CHECK (notes.taken() == std::vector<std::string> { "plan " + std::to_string (edited->serial()), "outdone 0 0", "tick" });
}

TEST_CASE ("a plan can be picked up before its tick, and values set later apply to it", "[live]")
{
    const auto sketch = Sketch {}.node ("one", "signal.constant", { { "value", 1.0 } });
    test::Live live { sketch.graph, catalogue(), { .records = { "one.out" } }, sketch.compile ({ .records = { "one.out" } }).plan };
    auto& engine = live.engine();
    engine.tick();
    const auto* first = &engine.plan();
    live.perform (graph::SetParam { .patch = {}, .node = "one", .param = "value", .value = 5.0 });
    CHECK (&engine.plan() == first);
    engine.takeSubmitted();
    CHECK (&engine.plan() != first);
    REQUIRE (live.set ("one.value", 2.0));
    for (int k = 0; k < 100; ++k)
        engine.tick();
    CHECK (*engine.plan().taps()[0].value == 2.0);
    engine.takeSubmitted();   // no plan is waiting
    CHECK (engine.newest().serial() == engine.plan().serial());
}

TEST_CASE ("every knob of a graph is found by its name", "[plan][property]")
{
    test::property ("any graph", [] {
        const auto graph = test::randomGraph (*rc::gen::arbitrary<unsigned>(), 15);
        const auto plan = compile (graph, catalogue()).plan;
        RC_ASSERT (plan);
        for (std::size_t i = 0; i < plan->instances().size(); ++i)
        {
            const auto& instance = plan->instances()[i];
            if (! instance.knobs) continue;
            const auto& node = plan->flat().nodes[i];
            std::size_t first = 0;
            for (std::size_t p = 0; p < node.type->params.size(); first += plan::Knobs::roomOf (node.type->params[p++]))
                for (std::size_t c = 0; c < plan->flat().param (static_cast<int> (i), p).size(); ++c)
                {
                    const auto found = plan::findParams (*plan, plan::nameOf (*plan, i, first + c));
                    RC_ASSERT (found.has_value());
                    const auto& refs = *found;
                    RC_ASSERT (refs.size() == 1u);
                    RC_ASSERT (refs[0].knobs == instance.knobs);
                    RC_ASSERT (refs[0].index == first + c);
                }
        }
    });
}

TEST_CASE ("a graph that is read again can get its ids back", "[graph]")
{
    auto graph = Sketch {}.node ("one", "signal.constant").node ("amp", "signal.gain").wire ("one.out -> amp.in").graph;
    auto& part = graph.graphs.emplace_back ("part", graph::Patch {}).second;
    part.nodes.push_back (Sketch::makeNode ("inner", "signal.abs"));
    part.nodes.back().origin = { { 7, 0 }, { 8, 2 } };
    auto again = graph;
    for (auto* node : { &again.root.nodes[0], &again.root.nodes[1], &again.graphs[0].second.nodes[0] })
    {
        node->id = graph::newId();
        node->origin.clear();
    }
    again.root.wires[0].id = graph::newId();

    const auto ids = graph::idsOf (graph);
    REQUIRE (graph::giveIds (again, Json::parse (ids.dump())));
    CHECK (graph::idsOf (again) == ids);
    CHECK (again.graphs[0].second.nodes[0].origin == std::vector<graph::Ancestor> { { 7, 0 }, { 8, 2 } });
    for (const auto* wrong :
         { "[1,2,3]", "[1,2,3,4,5]", "{}", "[1,2,3,-4]", "[1,2,3,[4]]", "[1,2,3,[4,5]]", "[1,2,3,[4,[5,-1]]]", "[1,2,3,[4,\"x\"]]", "[1,2,3,null]" })
        CHECK_FALSE (graph::giveIds (again, Json::parse (wrong)));
    CHECK (graph::idsOf (again) == ids);
}
