// SPDX-License-Identifier: MIT
// Guards that come with an edit: they tighten at once and without a step, and what loosens waits for the next run.

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/replay.hpp>
#include <tactus/run/run.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

using namespace tactus;

namespace
{
constexpr double dt = 1e-3;

/// Pushes with this size in everything that a guard limits.
Effort pushOf (double size)
{
    Effort e { .force = { size, 0.0, 0.0 }, .torque = { 0.0, size, 0.0 } };
    e.axes.set (0, size);
    e.signals.set (0, -size);
    e.signals.set (1, 0.1 * size);
    return e;
}

/// A hand that does not move.
class Still final : public Device
{
public:
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override { forces.push_back (e.force.x()); }
    void limitSignals (double max, double) override { max_signal = max; }
    DeviceLayout layout() const override { return { .buttons = { "grip" } }; }

    std::vector<double> forces;
    double max_signal = 0.0;
};

/// A graph that pushes a role, with 8 N by default.
graph::Graph pushing (const std::string& devices = "", double newtons = 8.0, const std::string& role = "tip")
{
    auto read = readGraph (R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000, "wires": [], "devices": { )" + devices + R"( }, "nodes": {
        "push": { "type": "signal.constant", "params": { "value": )"
                           + std::to_string (newtons) + R"( } },
        "motor": { "type": "device.force", "role": ")"
                           + role + R"(" } } })");
    INFO (test::text (read.messages));
    REQUIRE_FALSE (hasErrors (read.messages));
    read.graph.root.wires.push_back (*graph::parseWire ("push.out -> motor.force.x"));
    return std::move (read.graph);
}

std::string guarded (const std::string& guard, const std::string& role = "tip")
{
    return "\"" + role + R"(": { "driver": "sim", "guard": { )" + guard + " } }";
}

/// A file to include: a part without force of its own, whose author wants at most 1 N on "tip".
std::shared_ptr<const graph::Graph> part (const std::string& guard = R"("max_force": "1 N")")
{
    return std::make_shared<const graph::Graph> (pushing (guarded (guard), 0.0));
}

graph::Graph withPart (graph::Graph g, const std::string& more = "")
{
    auto read = readGraph (R"({ "format": "tactus-graph", "version": 1, "wires": [], "nodes": { "part": { "type": "file:part.json")" + more + " } } }");
    REQUIRE_FALSE (hasErrors (read.messages));
    g.root.nodes.push_back (read.graph.root.nodes.front());
    g.files["part.json"] = part();
    return g;
}

/// A run of a graph on devices with these limits, which is edited.
struct Bench
{
    explicit Bench (graph::Graph g, GuardLimits limits = {})
        : graph (std::move (g)), run (catalogue(), {}, [this, limits] (const std::string& role, const auto&...) -> Run::RoleDevice {
              auto device = std::make_unique<Still>();
              hands[role] = device.get();
              return { std::move (device), limits };
          })
    {
        const auto loaded = run.load (graph);
        INFO (test::text (loaded));
        REQUIRE (run.hasEngine());
    }

    Bench& begin()
    {
        Messages found;
        run.openDevices (graph, found);
        INFO (test::text (found));
        REQUIRE_FALSE (hasErrors (found));
        return tick (50);
    }

    Bench& tick (int count = 1)
    {
        for (int k = 0; k < count; ++k)
            run.tick();
        return *this;
    }

    Messages edit (graph::Graph next, bool commits = true)
    {
        auto edit = run.edit (next);
        if (edit.plan() != nullptr && commits)
        {
            edit.openDevices();
            edit.commit();
            graph = std::move (next);
        }
        return edit.messages();
    }

    const std::vector<double>& forces (const std::string& role = "tip") { return hands.at (role)->forces; }

    /// The forces after an edit fall from `from` to `to` within the fade, in equal steps, and then stay.
    void checkFall (double from, double to)
    {
        const auto begin = forces().size();
        tick (20);
        double before = from;
        for (auto k = begin; k < forces().size(); ++k)
        {
            const double now = forces()[k];
            CAPTURE (k - begin, before, now);
            CHECK (now <= before);
            CHECK (before - now <= (from - to) / 5.0 * (1.0 + 1e-9));
            if (k >= begin + 4) CHECK (now == Approx (to).margin (1e-12));
            before = now;
        }
    }

    std::map<std::string, Still*> hands;
    graph::Graph graph;
    Run run;
};

bool says (const Messages& messages, const std::string& id) { return test::has (messages, id); }
}   // namespace

//==============================================================================
TEST_CASE ("guard: a size limit that is tightened falls to its new value in equal steps, and nothing rises on the way", "[framework][guard][safety]")
{
    const double to = GENERATE (0.0, 0.5, 1.0, 7.9, 9.0);
    Guard guard;
    guard.prepare ({}, dt);
    guard (pushOf (8.0), {});
    CHECK (guard.tighten ({ .max_force = to, .max_torque = to, .max_axis_effort = to, .max_signal = to }));
    CHECK_FALSE (guard.tighten ({ .max_force = to + 1.0 }));
    auto before = pushOf (8.0);
    for (int k = 1; k <= 10; ++k)
    {
        auto wanted = pushOf (k % 2 == 0 ? 8.0 : 20.0);
        wanted.signals.set (1, 8.0);   // a signal that was low must not rise with the limit of the other one
        const auto now = guard (wanted, {});
        const double most = std::max (to, 8.0 - k * (8.0 - to) / 5.0) * (1.0 + 1e-12) + 1e-15;
        CAPTURE (to, k);
        CHECK (now.force.norm() <= most);
        CHECK (now.torque.norm() <= most);
        CHECK (std::abs (now.axes[0]) <= most);
        CHECK (std::abs (now.signals[0]) <= most);
        CHECK (now.signals[1] <= std::max (to, 0.8));
        if (to < 8.0) CHECK (before.force.x() - now.force.x() <= (8.0 - to) / 5.0 * (1.0 + 1e-9));
        if (to < 8.0) CHECK (now.force.x() <= before.force.x() * (1.0 + 1e-12));
        before = now;
    }
    CHECK (before.force.x() == Approx (std::min (8.0, to)).margin (1e-15));
}

TEST_CASE ("guard: a force above a tightened limit falls along the slew limit so far, not along the new one", "[framework][guard][safety]")
{
    Guard guard;
    guard.prepare ({ .max_force = 10.0, .max_slew = 500.0 }, dt);
    double before = 0.0;
    for (int k = 0; k < 100; ++k)
        before = guard (pushOf (8.0), {}).force.x();
    REQUIRE (before == 8.0);
    // Alone, 0.2 N/s would take 39 s from 8 N to 0.1 N; a stop may take half a second.
    guard.tighten ({ .max_force = 0.1, .max_slew = 0.2 });
    int ticks = 0;
    for (; before > 0.1 * (1.0 + 1e-9) && ticks < 1000; ++ticks)
    {
        const double now = guard (pushOf (8.0), {}).force.x();
        CHECK (before - now <= 0.5 * (1.0 + 1e-9));
        CHECK (now <= before);
        before = now;
    }
    CHECK (ticks == 16);
    guard (pushOf (8.0), {});
    const double now = guard (pushOf (0.0), {}).force.x();
    CHECK (0.1 - now <= 0.2e-3 * (1.0 + 1e-9));   // from now on, the new one
}

TEST_CASE ("guard: however often it is tightened while it pushes, no force is above what was there before or what all allow", "[framework][guard][property]")
{
    rc::check ([] {
        Guard guard;
        const double slew = *rc::gen::element (GuardLimits::none, 300.0, 5000.0);
        guard.prepare ({ .max_force = 100.0, .max_slew = slew }, dt);
        for (int k = 0; k < 400; ++k)
            guard (pushOf (50.0), {});
        double before = 50.0, allowed = 100.0;
        for (int k = 0; k < 60; ++k)
        {
            if (*rc::gen::inRange (0, 3) == 0)
            {
                const double to = *rc::gen::inRange (1, 600) / 10.0;
                guard.tighten ({ .max_force = to });
                allowed = std::min (allowed, to);
            }
            const double now = guard (pushOf (*rc::gen::inRange (0, 100)), {}).force.x();
            RC_ASSERT (now <= std::max (before, allowed) * (1.0 + 1e-12));
            RC_ASSERT (std::abs (now - before) <= slew * dt * (1.0 + 1e-9));
            before = now;
        }
        for (int k = 0; k < 200; ++k)
            before = guard (pushOf (50.0), {}).force.x();
        RC_ASSERT (before <= allowed);
    });
}

TEST_CASE ("guard: tightening keeps what impulse and energy have counted, and does not take what it newly watches for a jump", "[framework][guard][safety]")
{
    Guard guard;
    guard.prepare ({ .max_impulse = 10.0, .impulse_window = 1.0 }, dt);
    for (int k = 0; k < 900; ++k)
        guard (pushOf (2.0), {});   // 1.8 N s
    guard.tighten ({ .max_impulse = 2.0, .impulse_window = 10.0 });
    int ticks = 0;
    for (; ticks < 1000 && guard.stop() == Guard::Stop::none; ++ticks)
        guard (pushOf (2.0), {});
    CHECK (guard.stop() == Guard::Stop::impulse);
    CHECK (ticks < 110);

    Guard turned;
    turned.prepare ({ .max_speed = 10.0 }, dt);
    Reading far { .position = { 1.0, 0.0, 0.0 }, .rotation = { 0.0, 2.0, 0.0 } };
    for (int k = 0; k < 10; ++k)
        turned (pushOf (1.0), far);
    turned.tighten ({ .max_angular_speed = 1.0, .max_energy = 0.1, .energy_window = 1.0 });
    for (int k = 0; k < 10; ++k)
        turned (pushOf (1.0), far);
    CHECK (turned.stop() == Guard::Stop::none);
    far.rotation.y() += 0.1;
    turned (pushOf (1.0), far);
    turned (pushOf (1.0), far);
    CHECK (turned.stop() == Guard::Stop::speed);
}

TEST_CASE ("guard: tightening allocates nothing", "[framework][guard]")
{
    Guard guard;
    guard.prepare ({}, dt);
    guard (pushOf (8.0), {});
    NoAllocation watch;
    guard.tighten ({ .max_force = 1.0, .max_signal = 0.5, .max_energy = 1.0, .energy_window = 1.0 });
    guard (pushOf (8.0), {});
    CHECK (watch.allocations() == 0);
    CHECK (watch.locks() == 0);
}

//==============================================================================
TEST_CASE ("an edit that includes a graph with a guard tightens at once, and without a step", "[run][safety]")
{
    Bench bench (pushing());
    bench.begin();
    REQUIRE (bench.forces().back() == 8.0);
    CHECK_FALSE (says (bench.edit (withPart (bench.graph)), "watch/guard"));
    bench.checkFall (8.0, 1.0);
    CHECK (bench.run.devices().front().second.limits.max_force == 1.0);
}

TEST_CASE ("a guard that an edit adds to a role, or tightens, takes effect at once, and what it loosens waits and says so", "[run][safety]")
{
    const auto plain = pushing();
    Bench bench (plain);
    bench.begin();
    CHECK (bench.edit (pushing (guarded (R"("max_force": "3 N", "max_signal": 0.5)"))).empty());
    bench.checkFall (8.0, 3.0);
    CHECK (bench.hands.at ("tip")->max_signal == 0.5);

    CHECK (says (bench.edit (pushing (guarded (R"("max_force": "5 N")"))), "watch/guard"));
    CHECK (bench.tick (30).forces().back() == Approx (3.0));
    CHECK (says (bench.edit (plain), "watch/guard"));   // as an undo does
    CHECK (bench.tick (30).forces().back() == Approx (3.0));
    bench.edit (pushing (guarded (R"("max_force": "2 N")")));
    bench.checkFall (3.0, 2.0);
    CHECK (says (bench.edit (pushing (guarded (R"("max_force": "3 N")"))), "watch/guard"));
    CHECK (bench.tick (30).forces().back() == Approx (2.0));

    Bench next (plain);
    CHECK (next.begin().forces().back() == 8.0);
}

TEST_CASE ("the limits of the device stay, whatever an edit asks for", "[run][safety]")
{
    Bench bench (pushing(), { .max_force = 2.0, .max_signal = 0.25 });
    bench.begin();
    bench.edit (pushing (guarded (R"("max_force": "5 N", "max_signal": 1)")));
    CHECK (bench.tick (30).forces().back() == Approx (2.0));
    CHECK (bench.hands.at ("tip")->max_signal == 0.25);
    bench.edit (pushing());
    CHECK (bench.tick (30).forces().back() == Approx (2.0));
}

TEST_CASE ("an edit that adds an instance, or maps another role, tightens the guard of that role", "[run][safety]")
{
    const std::string mapped = R"(, "roles": { "tip": "other" })";
    Bench bench (withPart (pushing(), mapped));
    bench.begin();
    CHECK (bench.forces().back() == 8.0);
    const std::string two = R"(, "count": 2, "roles": { "tip": [ "other", "tip" ] })";
    bench.edit (withPart (pushing(), two));
    bench.checkFall (8.0, 1.0);

    Bench again (withPart (pushing(), mapped));
    again.begin();
    again.edit (withPart (pushing()));
    again.checkFall (8.0, 1.0);
}

TEST_CASE ("the guard of an edit that was replaced before it ran still counts", "[run][safety]")
{
    Bench bench (pushing());
    bench.begin();
    bench.edit (pushing (guarded (R"("max_force": "1 N")")));
    CHECK (says (bench.edit (pushing()), "watch/guard"));   // no tick between the two
    bench.checkFall (8.0, 1.0);

    Bench dropped (pushing());
    dropped.begin();
    dropped.edit (pushing (guarded (R"("max_force": "1 N")")), false);
    CHECK (dropped.tick (30).forces().back() == 8.0);   // never committed
}

TEST_CASE ("a role that an edit takes away and another one brings back keeps its guard", "[run][safety]")
{
    Bench bench (pushing (guarded (R"("max_force": "1 N")")));
    bench.begin();
    bench.edit (pushing ("", 8.0, "other"));
    bench.tick (30);
    CHECK (says (bench.edit (pushing()), "watch/guard"));
    CHECK (bench.tick (30).forces().back() == Approx (1.0));
}

TEST_CASE ("an edit whose guard cannot be read, or makes a stop too slow, is refused, and the previous plan keeps running", "[run][safety]")
{
    const auto* const guard = GENERATE (R"("max_force": "many")", R"("max_slew": "1 N/s")", R"("dead_man_button": "missing")");
    Bench bench (pushing());
    bench.begin();
    auto next = withPart (pushing ("", 5.0));
    next.files["part.json"] = part (guard);
    CHECK (hasErrors (bench.edit (next)));
    CHECK (hasErrors (bench.edit (pushing (guarded (guard), 5.0))));
    CHECK (bench.tick (30).forces().back() == 8.0);
    CHECK_FALSE (hasErrors (bench.edit (pushing ("", 5.0))));
    CHECK (bench.tick (30).forces().back() == 5.0);
}

TEST_CASE ("a dead man's switch that comes with an edit stops the force until its button is held", "[run][safety]")
{
    Bench bench (pushing());
    bench.begin();
    CHECK (bench.edit (pushing (guarded (R"("dead_man_button": "grip")"))).empty());
    bench.checkFall (8.0, 0.0);
    CHECK (bench.run.engine().guardOf ("tip").stop() == Guard::Stop::released);
}

TEST_CASE ("a run that continues another one keeps what its graphs have asked for", "[run][safety]")
{
    Bench first (pushing (guarded (R"("max_force": "1 N")")));
    first.begin();
    Bench next (pushing());
    next.run.keepLimits (first.run.askedLimits());
    Messages said;
    next.run.openDevices (next.graph, said);
    CHECK (says (said, "watch/guard"));
    CHECK (next.tick (30).forces().back() == Approx (1.0));
}

TEST_CASE ("a run that continues another one keeps its limits for a role that an edit has renamed", "[run][safety]")
{
    Bench first (pushing (guarded (R"("max_force": "1 N")")));
    first.begin();
    Bench next (pushing ("", 8.0, "pen"));   // maybe the same device
    next.run.keepLimits (first.run.askedLimits());
    Messages said;
    next.run.openDevices (next.graph, said);
    CHECK (next.tick (30).forces ("pen").back() == Approx (1.0));
}

TEST_CASE ("a log replays edits that tightened a guard to the bit, also one that was undone before it ran", "[run][runlog][safety]")
{
    const TemporaryFolder folder;
    const auto log = folder.path() / "run.jsonl";
    Bench bench (pushing());
    Messages found;
    bench.run.openDevices (bench.graph, found);
    REQUIRE (bench.run.startLog (log, "test", {}, bench.graph));
    const bool before_first_tick = GENERATE (false, true);
    if (! before_first_tick) bench.tick (5);
    bench.edit (pushing (guarded (R"("max_force": "3 N")")));
    bench.edit (pushing());   // replaces it, and is the graph that runs already
    bench.tick (7);
    bench.edit (withPart (pushing()));
    bench.tick (2);
    bench.edit (pushing (guarded (R"("max_force": "0.3 N", "max_slew": "2 N/s")")));
    bench.tick (400);
    REQUIRE (bench.run.finish());
    const auto& forces = bench.forces();
    REQUIRE (forces.back() == Approx (0.3));

    auto replay = Replay::open (log.string(), { .program = "test" });
    REQUIRE (replay);
    for (std::size_t k = 0; k < forces.size(); ++k)
    {
        const auto played = (*replay)->tick();
        REQUIRE (played);
        REQUIRE (*played);
        const double now = (*replay)->run().engine().role (0).applied.force.x();
        CAPTURE (k, now, forces[k]);
        REQUIRE (std::bit_cast<std::uint64_t> (now) == std::bit_cast<std::uint64_t> (forces[k]));
    }
}

TEST_CASE ("a log replays to the bit on a simulated tool that lacks the buttons of the device that the graph describes", "[run][runlog][safety]")
{
    const TemporaryFolder folder;
    const auto log = folder.path() / "run.jsonl";
    const auto describing = [] (double newtons) {
        return pushing (R"("tip": { "driver": "hid", "profile": "tactus_board", "guard": { "max_force": "2 N", "dead_man_button": "grip" } })", newtons);
    };
    auto graph = describing (8.0);
    Run run (catalogue(), {}, [] (const auto&...) -> Run::RoleDevice {
        return { makeDevice ({ { "driver", "sim" }, { "mass", 0.1 } }, {}).device, { .max_force = 5.0, .ramp = 0.01 } };
    });
    run.load (graph);
    Messages found;
    run.openDevices (graph, found);
    REQUIRE_FALSE (hasErrors (found));
    REQUIRE (says (found, "device/unknown_button"));
    REQUIRE (run.startLog (log, "test", {}, graph));
    std::vector<double> forces;
    const auto tick = [&] (int count) {
        for (int k = 0; k < count; ++k)
        {
            run.tick();
            forces.push_back (run.engine().role (0).applied.force.x());
        }
    };
    tick (20);
    graph = describing (3.0);
    if (auto edit = run.edit (graph); edit.plan() != nullptr) edit.commit();
    tick (20);
    REQUIRE (run.finish());
    REQUIRE (forces[19] == Approx (5.0));
    REQUIRE (forces.back() == Approx (3.0));

    auto replay = Replay::open (log.string(), { .program = "test" });
    REQUIRE (replay);
    for (const double force : forces)
    {
        const auto played = (*replay)->tick();
        REQUIRE (played);
        REQUIRE (*played);
        REQUIRE (std::bit_cast<std::uint64_t> ((*replay)->run().engine().role (0).applied.force.x()) == std::bit_cast<std::uint64_t> (force));
    }
}
