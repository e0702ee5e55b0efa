// SPDX-License-Identifier: MIT
// The class Run: compiling, opening devices, ticking, swapping plans and logging.

#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <tactus/run/probe/port_probes.hpp>
#include <tactus/run/replay.hpp>
#include <tactus/run/tick_clock.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>

using namespace tactus;
using test::Sketch;

namespace
{
/// A hand that moves by 1 mm a tick along x and records its forces.
class Hand final : public Device
{
public:
    void prepare (double) override {}
    Reading read() noexcept override { return { .position = { 1e-3 * ++reads, 0.0, 0.0 } }; }
    void write (const Effort& e) noexcept override { forces.push_back (e.force.x()); }

    int reads = 0;
    std::vector<double> forces;
};

/// Opens a Hand for each role and keeps a pointer to it.
struct Hands
{
    Run::OpenDevice opener()
    {
        return [this] (const std::string& role, const graph::Graph&, const Plan&, Messages&) -> Run::RoleDevice {
            auto hand = std::make_unique<Hand>();
            hands[role] = hand.get();
            return { std::move (hand), limits };
        };
    }

    GuardLimits limits {};
    std::map<std::string, Hand*> hands;
};

/// The force is `stiffness` (in N/m) times the position.
Sketch spring (double stiffness = 100.0)
{
    Sketch s;
    s.node ("hand", "device.position").node ("spring", "signal.gain", { { "gain", stiffness } }).node ("motor", "device.force");
    s.wire ("hand.position.x -> spring.in").wire ("spring.out -> motor.force.x");
    s.graph.root.wires[0].gain = "1 N/m";
    return s;
}

/// A real-time clock in virtual time that pauses again and again.
struct Pausing final : TickClock
{
    void drive (Ticked& t) noexcept override
    {
        for (int k = 0; t.tick (0.0); ++k)
            time += k % 50 < 40 ? 1e-3 : 20e-3;
    }
    double now() const noexcept override { return time; }
    double time = 0.0;
};

struct Counting final : RunListener
{
    std::vector<std::string> ports() const override { return wanted; }
    void planComes (const Plan&) override { ++plans; }
    void before (Plan&, std::uint64_t tick) noexcept override { CHECK (tick == befores++); }
    void after (const Plan&, std::uint64_t tick, bool) noexcept override { CHECK (tick == afters++); }

    std::vector<std::string> wanted;
    int plans = 0;
    std::uint64_t befores = 0, afters = 0;
};
}   // namespace

TEST_CASE ("a run reads, ticks and writes the devices that it opened", "[run]")
{
    Hands all;
    const auto s = spring();
    Run run { catalogue(), { .rate_hz = 1000.0 }, all.opener() };
    Counting listener;
    run.add (listener);
    auto messages = run.load (s.graph);
    INFO (test::text (messages));
    REQUIRE (run.hasEngine());
    run.openDevices (s.graph, messages);
    REQUIRE (all.hands.contains ("stylus"));

    for (int k = 0; k < 3; ++k)
        run.tick();
    const auto& forces = all.hands["stylus"]->forces;
    REQUIRE (forces.size() == 3);
    for (int k = 0; k < 3; ++k)
        CHECK (forces[static_cast<std::size_t> (k)] == Approx (0.1 * (k + 1)));
    CHECK (listener.befores == 3);
    CHECK (listener.afters == 3);
    CHECK (listener.plans == 1);
    CHECK (run.rate() == 1000.0);
}

TEST_CASE ("a graph that does not compile leaves a run without an engine, and the messages say why", "[run]")
{
    Run run { catalogue(), {} };
    const auto messages = run.load (Sketch {}.node ("a", "signal.gain").wire ("a.out -> a.in").graph);
    CHECK_FALSE (run.hasEngine());
    CHECK (hasErrors (messages));
}

TEST_CASE ("an edit takes over when it is committed, and has no effect when it is dropped", "[run]")
{
    Hands all;
    const auto soft = spring(), hard = spring (200.0);
    Run run { catalogue(), { .rate_hz = 1000.0 }, all.opener() };
    auto messages = run.load (soft.graph);
    run.openDevices (soft.graph, messages);
    REQUIRE (run.hasEngine());
    run.tick();

    auto harder = soft.graph;   // the same nodes with a different gain
    harder.root.nodes[1].params["gain"] = 200.0;
    SECTION ("dropped")
    {
        auto edit = run.edit (harder);
        REQUIRE (edit.plan() != nullptr);
    }
    SECTION ("dropped after another one was submitted: the submitted one still takes over")
    {
        {
            auto first = run.edit (harder);
            first.commit();
        }
        auto second = run.edit (soft.graph);
        second.drop();
        for (int k = 0; k < 100; ++k)
            run.tick();
        CHECK (all.hands["stylus"]->forces.back() == Approx (200.0 * 101e-3));
        return;
    }
    SECTION ("committed")
    {
        auto edit = run.edit (harder);
        edit.commit();
        for (int k = 0; k < 100; ++k)
            run.tick();
        CHECK (all.hands["stylus"]->forces.back() == Approx (200.0 * 101e-3));
        return;
    }
    for (int k = 0; k < 100; ++k)
        run.tick();
    CHECK (all.hands["stylus"]->forces.back() == Approx (100.0 * 101e-3));
}

TEST_CASE ("a new role of an edit gets its device when the edit is committed, and other roles keep theirs", "[run]")
{
    Hands all;
    const auto s = spring();
    Run run { catalogue(), { .rate_hz = 1000.0 }, all.opener() };
    auto messages = run.load (s.graph);
    run.openDevices (s.graph, messages);
    const auto* stylus = all.hands["stylus"];

    auto wider = s.graph;
    auto thumb = Sketch::makeNode ("thumb", "device.force");
    thumb.role = "thumb";
    wider.root.nodes.push_back (thumb);
    wider.root.wires.push_back (*graph::parseWire ("spring.out -> thumb.force.x"));
    auto edit = run.edit (wider);
    REQUIRE (edit.plan() != nullptr);
    edit.openDevices();
    edit.commit();
    run.tick();
    CHECK (run.devices().size() == 2);
    CHECK (all.hands["stylus"] == stylus);
    CHECK (all.hands["thumb"]->forces.size() == 1);
}

TEST_CASE ("a run keeps its rate, and reports this when an edit requests another one", "[run]")
{
    auto s = spring();
    s.graph.rate_hz = 1000.0;
    Run run { catalogue(), {} };
    run.load (s.graph);
    CHECK (run.rate() == 1000.0);
    s.graph.rate_hz = 2000.0;
    auto edit = run.edit (s.graph);
    CHECK (test::has (edit.messages(), "watch/rate"));
    edit.commit();
    run.tick();
    CHECK (run.rate() == 1000.0);
}

TEST_CASE ("an edit may remove a port of a listener, but not a recorded one", "[run]")
{
    const auto s = spring();
    auto without = Sketch {}.node ("hand", "device.position").node ("motor", "device.force").wire ("hand.position.x -> motor.force.x");
    without.graph.root.wires[0].gain = "1 N/m";
    Counting listener;
    SECTION ("the port of a listener")
    {
        listener.wanted = { "spring.out" };
        Run run { catalogue(), { .records = { "motor.force.x" } } };
        run.add (listener);
        run.load (s.graph);
        CHECK (run.engine().newest().taps().size() == 2);
        auto edit = run.edit (without.graph);
        REQUIRE (edit.plan() != nullptr);
        CHECK (edit.plan()->taps().size() == 1);
    }
    SECTION ("a recorded port")
    {
        Run run { catalogue(), { .records = { "spring.out" } } };
        run.load (s.graph);
        CHECK (run.edit (without.graph).plan() == nullptr);
    }
}

TEST_CASE ("a graph that does not compile at the rate of a clock does not run at its own rate", "[run]")
{
    Sketch s;
    s.add (s.subgraph ("part"), "gain", "signal.gain");
    s.node ("slow", "graph:part");
    s.graph.root.nodes.back().extra = Json { { "every", 500 } };
    Run run { catalogue(), {} };
    REQUIRE_FALSE (hasErrors (run.load (s.graph)));   // 1000 Hz / 500
    REQUIRE (run.hasEngine());
    run.setRate (100.0);
    const auto messages = run.load (s.graph);
    CHECK (std::ranges::count (messages, "rate/value", &Message::id) == 1);
    CHECK_FALSE (run.hasEngine());
}

TEST_CASE ("probes see the values of ports, and a failed probe leaves the earlier ones running", "[run]")
{
    const auto s = spring();
    PortProbes probes;
    Run run { catalogue(), { .rate_hz = 1000.0 } };
    run.add (probes);
    auto messages = run.load (s.graph);
    run.openDevices (s.graph, messages);

    const auto names = probes.probe (run, s.graph, { "motor.force" });
    REQUIRE (names);
    CHECK (*names == std::vector<std::string> { "motor.force.x", "motor.force.y", "motor.force.z" });
    CHECK_FALSE (probes.probe (run, s.graph, { "nothing.out" }));
    CHECK (probes.ports() == std::vector<std::string> { "motor.force" });

    for (int k = 0; k < 5; ++k)
        run.tick();
    int seen = 0;
    probes.drain ([&] (std::uint64_t, std::span<const double> values) {
        CHECK (values.size() == 3);
        ++seen;
    });
    CHECK (seen == 5);
}

TEST_CASE ("a capture contains the window around its trigger, and an edit of other nodes does not end it", "[run]")
{
    Hands all;
    auto s = spring();
    Run run { catalogue(), { .rate_hz = 1000.0 }, all.opener() };
    auto messages = run.load (s.graph);
    run.openDevices (s.graph, messages);
    const auto names = run.capture (s.graph, "spring.out", "hand.position.x", { .level = 10.5e-3, .before = 2, .after = 2 });
    REQUIRE (names);
    CHECK (*names == std::vector<std::string> { "spring.out" });
    run.tick();

    s.node ("idle", "signal.abs");
    auto edit = run.edit (s.graph);
    edit.commit();
    for (int k = 0; k < 20; ++k)
        run.tick();
    REQUIRE (run.captured() != nullptr);
    CHECK (run.captured()->frame (2)[0] == Approx (100.0 * 11e-3));
    run.endCapture();
    CHECK (run.captured() == nullptr);
    CHECK_FALSE (run.capture (s.graph, "nothing.out", "hand.position.x", {}));
    CHECK_FALSE (run.isCapturing());
}

TEST_CASE ("a live run ends at rest, and its log replays bit for bit", "[run]")
{
    const TemporaryFolder folder;
    const auto path = folder / "run.jsonl";
    std::vector<double> live;
    {
        Hands all;
        const bool pauses = GENERATE (false, true);
        if (pauses) all.limits = { .max_force = 50.0, .max_slew = 200.0, .ramp = 0.01, .watchdog = 0.05 };
        const auto s = spring();
        FreeRun free_run;
        Pausing pausing;
        TickClock& clock = pauses ? static_cast<TickClock&> (pausing) : free_run;
        Run run { catalogue(), { .rate_hz = 1000.0 }, all.opener(), Run::Queries::on_thread };
        auto messages = run.load (s.graph);
        run.openDevices (s.graph, messages);
        REQUIRE (run.devices().size() == 1);
        REQUIRE (run.startLog (path, "test 1", {}, s.graph));
        run.start (clock, { .length = 200 });
        run.live().wait();
        REQUIRE (run.finish());
        live = all.hands["stylus"]->forces;
        REQUIRE (live.size() >= 200);
        CHECK (run.live().status().roles[0].event.why == (pauses ? Guard::Stop::starved : Guard::Stop::halted));
    }
    auto replayed = Replay::open (path.string(), { .program = "test 1" });
    REQUIRE (replayed);
    CHECK ((*replayed)->takeWarnings().empty());
    auto& run = (*replayed)->run();
    std::size_t ticks = 0;
    for (;; ++ticks)
    {
        const auto more = (*replayed)->tick();
        REQUIRE (more);
        if (! *more) break;
        REQUIRE (ticks < live.size());
        CHECK (run.engine().role (0).applied.force.x() == live[ticks]);
    }
    CHECK (ticks == 200);
    CHECK_FALSE ((*replayed)->end());
}
