// SPDX-License-Identifier: MIT
#include <tactus/run/runner.hpp>

#include "support/chance_hand.hpp"
#include "support/no_allocation.hpp"
#include "support/no_system_calls.hpp"
#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <vector>

#include <unistd.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace tactus;
using End = RunStatus::End;
using Phase = RunStatus::Phase;

namespace
{
constexpr double rate_hz = 4000.0;

/// A hand that rubs a wall and never leaves it.
test::Sketch rubbed()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("wall", "deform.plane", { { "offset", "1 mm" } });
    s.node ("drag", "friction.elasto_plastic").node ("motor", "device.force");
    s.wire ("hand.position -> wall.position").wire ("hand.position -> drag.position").wire ("wall.resistance -> drag.normal_force");
    return s.wire ("wall.force -> motor.force").wire ("drag.force -> motor.force");
}

struct Rubbed
{
    explicit Rubbed (const GuardLimits& limits = {})
        : engine (rubbed().compile ({ .rate_hz = rate_hz, .records = { "drag.force.x" } }).plan)
    {
        engine.attach ("stylus", hand, limits);
    }

    test::ChanceHand hand { 1 };
    Engine engine;
    FreeRun clock;
};

/// Records whether each tick was halted, and whether the ticks came in order.
struct Notes final : TickHooks
{
    explicit Notes (std::size_t room) { halts.reserve (room); }
    void before (std::uint64_t tick) noexcept override { in_order = in_order && tick == halts.size(); }
    void after (std::uint64_t, bool now_halts) noexcept override { halts.push_back (now_halts); }

    bool in_order = true;
    std::vector<bool> halts;
};

/// Runs `meanwhile` on this thread during the run.
template <typename F>
RunStatus play (Runner& runner, F&& meanwhile)
{
    runner.start();
    meanwhile();
    runner.wait();
    return runner.status();
}
RunStatus play (Runner& runner)
{
    return play (runner, [] {});
}
}   // namespace

TEST_CASE ("a run ticks for its length and then until the force is zero, bit-identical to the engine alone", "[runtime]")
{
    Rubbed run, alone;
    Notes notes { 2000 };
    Runner runner { run.engine, run.clock, rate_hz, { .length = 1000, .hooks = &notes } };
    CHECK (runner.status().phase == Phase::running);
    const auto end = play (runner);
    CHECK (end.phase == Phase::over);
    CHECK (end.end == End::length);
    CHECK_FALSE (end.let_go_under_force);
    CHECK (end.ticks == notes.halts.size());
    CHECK (end.ticks > 1000);
    CHECK (end.ticks <= 1000 + static_cast<std::uint64_t> (Guard::fade_s * rate_hz) + 2);
    CHECK (notes.in_order);
    CHECK (std::ranges::count (notes.halts, false) == 1000);
    CHECK (run.hand.last.force.isZero (0.0));
    CHECK (end.force == 0.0);
    CHECK (end.peak > 0.5);
    REQUIRE (end.role_count == 1);
    CHECK (end.roles[0].name == "stylus");
    CHECK (end.roles[0].stop == Guard::Stop::halted);
    CHECK (runner.account().ticks() == end.ticks);

    for (std::uint64_t k = 0; k < end.ticks; ++k)
    {
        if (k >= 1000) alone.engine.halt();
        alone.engine.tick();
    }
    CHECK (run.hand.digest == alone.hand.digest);
    CHECK (runner.costs().size() <= 4);
}

TEST_CASE ("a run that is stopped in any way brings the force to zero smoothly and ends", "[runtime]")
{
    static std::atomic<bool> signalled;
    signalled = false;
    Rubbed run { { .max_slew = 50.0 } };
    Runner runner { run.engine, run.clock, rate_hz, { .stop_wanted = []() noexcept { return signalled.load(); } } };
    const bool by_signal = GENERATE (true, false);
    const auto end = play (runner, [&] {
        while (runner.status().force < 0.5)
            std::this_thread::yield();
        CHECK_FALSE (runner.isOver());
        by_signal ? signalled = true : (runner.stop(), true);
    });
    CHECK (end.end == End::asked);
    CHECK (runner.isOver());
    CHECK (run.hand.last.force.isZero (0.0));

    Rubbed left { { .max_slew = 50.0 } };
    {
        Runner forgotten { left.engine, left.clock, rate_hz, {} };
        forgotten.start();
        while (forgotten.status().force < 0.5)
            std::this_thread::yield();
    }
    CHECK (left.hand.last.force.isZero (0.0));

    Runner again { left.engine, left.clock, rate_hz, { .length = 4000 } };
    CHECK (play (again).peak > 0.5);   // in a new run, a halted engine delivers force again
}

TEST_CASE ("a run of some seconds lasts as long by the clock, also if it loses ticks or is ticked faster than it says", "[runtime]")
{
    /// A clock with deadlines whose time the test makes.
    struct MadeClock final : TickClock
    {
        void drive (Ticked& ticked) noexcept override
        {
            for (bool more = true; more; ++ticks)
            {
                time += ticks == stall_at ? stall_s : step_s;
                more = ticked.tick (0.0);
            }
        }
        double now() const noexcept override { return time; }

        double time = 1000.0, step_s = 1.0 / rate_hz, stall_s = 4.0;
        std::uint64_t ticks = 0, stall_at = std::numeric_limits<std::uint64_t>::max();
    };
    struct Way
    {
        double step = 1.0;   // in periods
        bool stalls = false;
        std::uint64_t ticks = 0;   // within the 10 s, but not those of the end
    };
    const auto all = static_cast<std::uint64_t> (10.0 * rate_hz), lost = static_cast<std::uint64_t> (4.0 * rate_hz);
    const auto way = GENERATE_COPY (Way { 1.0, false, all }, Way { 1.0, true, all - lost + 1 }, Way { 2.0, false, all / 2 }, Way { 0.5, false, 2 * all });
    Rubbed run;
    MadeClock clock;
    clock.step_s *= way.step;
    if (way.stalls) clock.stall_at = all / 4;
    Notes notes { 4 * all };
    Runner runner { run.engine, clock, rate_hz, { .length_s = 10.0, .hooks = &notes } };
    const auto end = play (runner);
    CHECK (end.end == End::length);
    const auto ran = static_cast<double> (std::ranges::count (notes.halts, false));
    CHECK (std::abs (ran - static_cast<double> (way.ticks)) <= 3.0);

    // Without deadlines, the ticks are the time.
    Rubbed free;
    Notes more { 2000 };
    Runner fast { free.engine, free.clock, rate_hz, { .length_s = 1000.0 / rate_hz, .hooks = &more } };
    CHECK (play (fast).end == End::length);
    CHECK (std::ranges::count (more.halts, false) == 1000);
}

TEST_CASE ("a run of length zero does not tick", "[runtime]")
{
    Rubbed run;
    Runner runner { run.engine, run.clock, rate_hz, { .length = 0 } };
    const auto end = play (runner);
    CHECK (end.ticks == 0);
    CHECK (end.phase == Phase::over);
}

TEST_CASE ("a run ends even if a slew limit keeps force on a device: the device is released after a while, and the status reports it", "[runtime]")
{
    struct Still final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override { return {}; }
        void write (const Effort&) noexcept override {}
    } device;
    Engine engine { rubbed().compile ({ .rate_hz = rate_hz }).plan };
    engine.attach ("stylus", device, { .max_slew = 0.02 });
    FreeRun clock;
    Runner runner { engine, clock, rate_hz, { .length = 400000 } };
    const auto end = play (runner);
    CHECK (end.let_go_under_force);
    CHECK (end.ticks == 400000 + static_cast<std::uint64_t> (Runner::longest_halt_s * rate_hz) + 1);
    CHECK (end.force == Approx (1.0 - 0.02 * Runner::longest_halt_s).epsilon (0.01));
}

TEST_CASE ("the status shows the force and the torque that the motors render, not what the guard lets through", "[runtime]")
{
    struct Weak final : Device   // its motors render a quarter of each effort
    {
        Effort last;
        void prepare (double) override {}
        Reading read() noexcept override
        {
            Reading reading;
            reading.unrendered_force = 0.75 * last.force;
            reading.unrendered_torque = 0.75 * last.torque;
            return reading;
        }
        void write (const Effort& e) noexcept override { last = e; }
    } device;
    test::Sketch s;
    s.node ("push", "signal.constant", { { "value", 2.0 } }).node ("turn", "signal.constant", { { "value", 2.0 } });
    s.node ("motor", "device.force").wire ("push.out -> motor.force.x").wire ("turn.out -> motor.torque.y");
    const auto compiled = s.compile ({ .rate_hz = rate_hz });
    REQUIRE (compiled.plan);
    Engine engine { compiled.plan };
    engine.attach ("stylus", device, {});
    FreeRun clock;

    struct LastTick final : TickHooks
    {
        RunStatus seen;
        const Runner* runner = nullptr;
        void before (std::uint64_t) noexcept override { seen = runner->status(); }
        void after (std::uint64_t, bool) noexcept override {}
    } hooks;
    Runner runner { engine, clock, rate_hz, { .length = 100, .hooks = &hooks } };
    hooks.runner = &runner;
    const auto end = play (runner);
    CHECK (end.peak == 0.5);
    CHECK (hooks.seen.peak == 0.5);
    CHECK (hooks.seen.roles[0].force > 0.0);   // it fades
    CHECK (hooks.seen.roles[0].force < 0.5);
    CHECK (hooks.seen.roles[0].torque == hooks.seen.roles[0].force);
    CHECK (end.force == 0.0);
    CHECK (end.roles[0].force == 0.0);
    CHECK (end.roles[0].torque == 0.0);
}

TEST_CASE ("a run whose graph takes longer than a tick period is halted with the reason overrun", "[runtime]")
{
    struct Slow final : TickClock
    {
        void drive (Ticked& t) noexcept override
        {
            while (t.tick (1e-3))
                ;
        }
        double now() const noexcept override { return time += 1e-3; }
        mutable double time = 0.0;
    } clock;
    Rubbed run;
    Runner runner { run.engine, clock, rate_hz, {} };
    const auto end = play (runner);
    CHECK (end.end == End::overrun);
    CHECK (end.misses == end.ticks);
    CHECK (end.ticks > static_cast<std::uint64_t> (TickAccount::longest_overrun_s / 4e-3));
    CHECK (run.hand.last.force.isZero (0.0));
}

TEST_CASE ("the status shows why a guard stops, with its numbers, while the run continues", "[runtime]")
{
    struct Falls final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override { return { .age = tick++ < 400 ? 0.0 : 0.031 }; }
        void write (const Effort&) noexcept override {}
        int tick = 0;
    } device;
    Engine engine { rubbed().compile ({ .rate_hz = rate_hz }).plan };
    engine.attach ("stylus", device, { .watchdog = 0.020 });
    FreeRun clock;
    Runner runner { engine, clock, rate_hz, {} };
    RunStatus seen;
    play (runner, [&] {
        while ((seen = runner.status()).roles[0].stop == Guard::Stop::none)
            std::this_thread::yield();
        runner.stop();
    });
    CHECK (seen.ticks >= 400);
    CHECK (seen.roles[0].stop == Guard::Stop::stale);
    CHECK (seen.roles[0].latest == Guard::Stop::stale);
    CHECK (describe (seen.roles[0].latestEvent()) == "the last reading is 31 ms old; the watchdog allows 20 ms");
}

TEST_CASE ("an audio card can own the clock and tick a block at a time on its own thread", "[runtime]")
{
    struct Card final : TickClock
    {
        void drive (Ticked& t) noexcept override
        {
            std::jthread ([&] {
                for (bool more = true; more;)
                    for (int i = 0; i < 64 && more; ++i)
                    {
                        more = t.tick (0.0);
                        ++ticks;
                    }
            })
                .join();
        }
        double now() const noexcept override { return ticks / rate_hz; }
        double ticks = 0.0;
    } card;
    Rubbed run, alone;
    Runner by_card { run.engine, card, rate_hz, { .length = 1000 } }, by_itself { alone.engine, alone.clock, rate_hz, { .length = 1000 } };
    CHECK (play (by_card).ticks == play (by_itself).ticks);
    CHECK (run.hand.digest == alone.hand.digest);
}

TEST_CASE ("a device can own the clock: when it falls silent, its guard removes the force, and a stop request still works", "[runtime]")
{
    /// Sends reports for 100 ticks, then falls silent.
    struct Stylus final : Device, TickClock
    {
        void prepare (double) override {}
        Reading read() noexcept override { return { .age = silent ? 1.0 : 0.0 }; }
        void write (const Effort& e) noexcept override { force = e.force.norm(); }

        void drive (Ticked& t) noexcept override
        {
            for (int k = 0; t.tick (0.0); ++k)
                if (k >= 100)
                {
                    silent = true;
                    test::letPass (std::chrono::milliseconds (1));   // waits for a report that never comes
                }
        }

        bool silent = false;
        std::atomic<double> force = 0.0;
    } stylus;
    Engine engine { rubbed().compile ({ .rate_hz = rate_hz }).plan };
    engine.attach ("stylus", stylus, { .watchdog = 0.020 });
    Runner runner { engine, stylus, rate_hz, {} };
    const auto end = play (runner, [&] {
        while (runner.status().roles[0].stop != Guard::Stop::stale || runner.status().force > 0.0)
            std::this_thread::yield();
        runner.stop();
    });
    CHECK (end.end == End::asked);
    CHECK (end.peak > 0.5);
    CHECK (stylus.force == 0.0);
}

#if defined(__SSE2__)
TEST_CASE ("a run computes with denormal numbers, regardless of the floating-point mode of the starting thread", "[runtime]")
{
    test::Sketch s;
    s.node ("one", "signal.constant", { { "value", 1e-200 } }).node ("amp", "signal.gain", { { "gain", 1e-115 } }).wire ("one.out -> amp.in");
    const auto plan = s.compile ({ .rate_hz = rate_hz, .records = { "amp.out" } }).plan;
    REQUIRE (plan);
    Engine engine { plan };
    FreeRun clock;
    Runner runner { engine, clock, rate_hz, { .length = 3 } };
    const auto before = _mm_getcsr();
    _mm_setcsr (before | 0x8040);   // sets flush-to-zero and denormals-are-zero
    runner.start();
    runner.wait();
    _mm_setcsr (before);
    CHECK (*plan->taps()[0].value == 1e-200 * 1e-115);
    CHECK (*plan->taps()[0].value > 0.0);
}
#endif

TEST_CASE ("a tick of a run allocates nothing and takes no lock", "[runtime]")
{
    struct Watched final : TickClock
    {
        void drive (Ticked& t) noexcept override
        {
            const NoAllocation watch;
            while (t.tick (0.0))
                ;
            seen = watch.allocations() + watch.locks();
        }
        int seen = -1;
    } clock;
    Rubbed run;
    Notes notes { 30000 };
    Runner runner { run.engine, clock, rate_hz, { .length = 20000, .hooks = &notes } };
    play (runner);
    CHECK (clock.seen == 0);
    CHECK_FALSE (runner.costs().empty());
}

TEST_CASE ("in a free run, a tick makes no system calls", "[runtime]")
{
    if (! test::canForbidSystemCalls())
    {
        WARN ("skipped: seccomp filters are not available here");
        return;
    }
    struct Sealed final : TickClock
    {
        void drive (Ticked& t) noexcept override
        {
            test::forbidSystemCalls();
            while (t.tick (0.0))
                ;
            _exit (0);
        }
    };
    const auto end = test::inChild ([] {
        Sealed clock;
        Rubbed run;
        Runner runner { run.engine, clock, rate_hz, { .length = 100000 } };
        runner.start();
        runner.wait();
        return 1;
    });
    CHECK (end.signal == 0);
    CHECK (end.status == 0);
}
