// SPDX-License-Identifier: MIT
// Devices for roles that appear while a graph runs.

#include "support/chance_hand.hpp"
#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"

#include <catch2/catch.hpp>

#include <numbers>
#include <stdexcept>

using namespace tactus;

namespace
{
constexpr double rate_hz = 4000.0;

/// A hand inside a wall, so it is pushed from the first tick.
test::Sketch pushed()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("wall", "deform.plane", { { "offset", "1 cm" } }).node ("motor", "device.force");
    return s.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
}

/// A thumb inside another wall.
test::Sketch& addThumb (test::Sketch& s)
{
    s.node ("thumb", "device.position").node ("nail", "deform.plane", { { "offset", "2 cm" } }).node ("thimble", "device.force");
    for (const auto* name : { "thumb", "thimble" })
        std::ranges::find (s.graph.root.nodes, name, &graph::Node::name)->role = "thumb";
    return s.wire ("thumb.position -> nail.position").wire ("nail.force -> thimble.force");
}

/// Counts how often it is read, and records the efforts it receives.
struct Thumb final : Device
{
    void prepare (double dt_s) override { dt = dt_s; }
    Reading read() noexcept override
    {
        ++reads;
        return {};
    }
    void write (const Effort& e) noexcept override { efforts.push_back (e.force.z()); }

    double dt = 0.0;
    int reads = 0;
    std::vector<double> efforts;
};

std::shared_ptr<Plan> after (const test::Sketch& s, Engine& engine) { return s.compile ({ .rate_hz = rate_hz, .before = &engine.newest() }).plan; }
}   // namespace

TEST_CASE ("a device joins on the tick that picks up the plan with its role, and its force rises without a step", "[live]")
{
    auto sketch = pushed();
    Engine engine { sketch.compile ({ .rate_hz = rate_hz }).plan }, alone { sketch.compile ({ .rate_hz = rate_hz }).plan };
    test::ChanceHand hand { 1 }, other { 1 };
    engine.attach ("stylus", hand);
    alone.attach ("stylus", other);
    const auto tick = [&] (int n) {
        const NoAllocation watch;
        for (int k = 0; k < n; ++k)
        {
            engine.tick();
            alone.tick();
        }
        return watch.allocations() + watch.locks();
    };
    tick (100);

    Thumb thumb;
    thumb.efforts.reserve (1000);
    addThumb (sketch);
    const Engine::Joining joining { "thumb", thumb, { .max_force = 15.0 } };
    engine.submit (after (sketch, engine), std::span (&joining, 1));
    CHECK (thumb.dt == 1.0 / rate_hz);
    CHECK (thumb.reads == 0);
    CHECK (tick (500) == 0);
    CHECK (thumb.reads == 500);
    REQUIRE (thumb.efforts.size() == 500);
    CHECK (thumb.efforts[0] == 0.0);
    double largest = 0.0;
    for (std::size_t k = 1; k < thumb.efforts.size(); ++k)
        largest = std::max (largest, std::abs (thumb.efforts[k] - thumb.efforts[k - 1]));
    CHECK (largest <= 20.0 * std::numbers::pi / (2.0 * Bumpless::rise_s * rate_hz) * (1.0 + 1e-9));
    CHECK (thumb.efforts.back() == Approx (15.0));   // the wall pushes with 20 N; the guard cuts off the rest
    CHECK (hand.digest == other.digest);
}

TEST_CASE ("a role that ran without a device can be given one, with its own plan or a later one", "[live]")
{
    auto sketch = pushed();
    Engine engine { addThumb (sketch).compile ({ .rate_hz = rate_hz }).plan };
    for (int k = 0; k < 100; ++k)
        engine.tick();
    Thumb thumb;
    const Engine::Joining joining { "thumb", thumb };
    engine.submit (after (sketch, engine), std::span (&joining, 1));
    for (int k = 0; k < 500; ++k)
        engine.tick();
    CHECK (thumb.reads == 500);
    CHECK (thumb.efforts[0] == 0.0);
    CHECK (thumb.efforts.back() == Approx (20.0));
    CHECK (&engine.guardOf ("thumb") == &engine.role (1).guard);
    CHECK (engine.role (1).name == "thumb");
}

TEST_CASE ("a role added by an edit can get its device before the edit has run", "[live]")
{
    auto sketch = pushed();
    test::Live live { sketch.graph, catalogue(), { .rate_hz = rate_hz }, sketch.compile ({ .rate_hz = rate_hz }).plan };
    auto thimble = test::Sketch::makeNode ("thimble", "device.force");
    thimble.role = "thumb";
    CHECK_FALSE (hasErrors (live.perform (graph::AddNode { "", thimble })));
    CHECK_FALSE (hasErrors (live.perform (graph::AddWire { "", *graph::parseWire ("wall.force -> thimble.force") })));
    Thumb thumb;
    const Engine::Joining joining { "thumb", thumb };
    CHECK_FALSE (hasErrors (live.join (std::span (&joining, 1))));
    for (int k = 0; k < 500; ++k)
        live.engine().tick();
    CHECK (thumb.reads == 500);
    CHECK (thumb.efforts.back() == Approx (10.0));
}

TEST_CASE ("a device keeps its role if the plan it joined with never runs", "[live]")
{
    auto sketch = pushed();
    Engine engine { sketch.compile ({ .rate_hz = rate_hz }).plan };
    addThumb (sketch);
    Thumb thumb;
    const Engine::Joining joining { "thumb", thumb };
    engine.submit (after (sketch, engine), std::span (&joining, 1));
    engine.withdraw();
    engine.tick();
    CHECK (thumb.reads == 0);
    engine.submit (after (sketch, engine));
    engine.tick();
    CHECK (thumb.reads == 1);
}

TEST_CASE ("joining a role that does not exist, or that already has a device, is refused", "[live]")
{
    auto sketch = pushed();
    Engine engine { addThumb (sketch).compile ({ .rate_hz = rate_hz }).plan };
    Thumb thumb;
    engine.attach ("thumb", thumb);
    const Engine::Joining again { "thumb", thumb }, unknown { "toe", thumb };
    CHECK_THROWS_AS (engine.submit (after (sketch, engine), std::span (&again, 1)), std::invalid_argument);
    CHECK_THROWS_AS (engine.submit (after (sketch, engine), std::span (&unknown, 1)), std::out_of_range);
    engine.tick();
    CHECK (thumb.reads == 1);
}
