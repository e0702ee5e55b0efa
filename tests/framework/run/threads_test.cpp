// SPDX-License-Identifier: MIT
// All threads of a live run at the same time, mainly for TSan. TACTUS_LIVE_SECONDS makes the test longer.

#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/run/probe_ring.hpp>
#include <tactus/run/runner.hpp>

#include "support/chance_hand.hpp"
#include "support/no_allocation.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdlib>
#include <iostream>

using namespace tactus;

namespace
{
constexpr double rate_hz = 4000.0;

/// A graph that counts the ticks, with a parameter to turn, a part with a steady force, and a part to edit.
test::Sketch sketched()
{
    test::Sketch s { test::sideBySide (test::prefixed (test::randomGraph (5, 20), "s_", "left"), test::prefixed (test::randomGraph (6, 30), "e_", "right")) };
    s.node ("s_hand", "device.position").node ("s_wall", "deform.plane").node ("s_motor", "device.force");
    s.wire ("s_hand.position -> s_wall.position").wire ("s_wall.force -> s_motor.force");
    s.node ("one", "signal.constant", { { "value", 1.0 } }).node ("count", "signal.add").node ("turned", "signal.gain");
    return s.wire ("one.out -> count.in[0]").wire ("count.out -> [1] -> count.in[1]").wire ("one.out -> turned.in");
}

/// Records and probes a run: the first tap counts ticks, and the second one follows the turned parameter.
class Taps final : public TickHooks
{
public:
    explicit Taps (Engine& e) : engine (e) {}

    void before (std::uint64_t) noexcept override { watch.emplace(); }
    void after (std::uint64_t tick, bool) noexcept override
    {
        probes.note (engine.plan(), tick);
        const auto frame = frames.claim();
        for (std::size_t i = 0; i < frame.size(); ++i)
            frame[i] = *engine.plan().taps()[i].value;
        frames.commit();
        unclean += watch->allocations() + watch->locks();
        watch.reset();
    }

    SpscRing<double> frames { 4096, 2 };
    ProbeRing probes;
    int unclean = 0;   ///< allocations, frees and locks in all ticks

private:
    Engine& engine;
    std::optional<NoAllocation> watch;
};
}   // namespace

// Long because it is one scenario: five threads work on a live run, and the final checks use their counts.
TEST_CASE ("an editor, a turned knob, a probe reader, a recorder and a status reader do not disturb a run", "[runtime]")
{
    const auto sketch = sketched();
    const CompileOptions options { .rate_hz = rate_hz, .records = { "count.out", "turned.out" } };
    const auto first = sketch.compile (options);
    INFO (test::text (first.messages));
    REQUIRE (first.plan);
    test::Live live { sketch.graph, catalogue(), options, first.plan };
    test::ChanceHand hand { 1 };
    live.engine().attach ("stylus", hand);
    const auto gain = *live.engine().param ("turned.gain");

    Taps taps { live.engine() };
    const std::size_t all[] { 0, 1 };
    taps.probes.select (all, 3);
    AbsoluteTimer clock { 1.0 / rate_hz };
    Runner runner { live.engine(), clock, rate_hz, { .hooks = &taps } };
    runner.start();

    std::atomic<std::uint64_t> probed = 0, recorded = 0, looked = 0;
    std::atomic<int> broken = 0;
    std::vector<std::jthread> others;
    const auto beside = [&] (auto what) {
        others.emplace_back ([what] (const std::stop_token& over) mutable {
            for (; ! over.stop_requested(); std::this_thread::yield())
                what();
        });
    };
    beside ([&, i = 0]() mutable { live.engine().set (gain, i++ % 100); });
    beside ([&] {
        taps.probes.drain ([&] (const ProbeRing::Frame& f) {
            broken += f.size != 2 || f.tick % 3 != 0 || f.values[0] != static_cast<double> (f.tick + 1);
            ++probed;
        });
    });
    beside ([&, last = 0.0]() mutable {
        taps.frames.drain ([&] (std::span<const double> f) {
            broken += ! (f[0] > last) || ! (f[1] >= 0.0 && f[1] < 100.0);
            last = f[0];
            ++recorded;
        });
    });
    beside ([&, last = RunStatus {}]() mutable {
        const auto now = runner.status();
        broken += now.ticks < last.ticks || now.peak < now.force || (now.ticks > 0 && now.shown().empty()) || runner.account().lateness().quantile (0.99) < 0.0;
        last = now;
        ++looked;
    });

    std::mt19937 random { 7 };
    const auto* wanted = std::getenv ("TACTUS_LIVE_SECONDS");
    const std::chrono::milliseconds least { wanted ? 1000 * std::stoi (wanted) : 500 };
    int edits = 0;
    for (const test::Stopwatch watch; ! watch.hasRun (least) || edits <= 10 || probed <= 10 || recorded <= 10 || looked <= 10; ++edits)
    {
        if (live.history().position() > 50)
            while (live.history().position() > 0)
                live.undo();
        auto messages = live.perform (test::randomEdit (random, live.graph(), "e_", "right"));
        while (hasErrors (messages))
            messages = live.undo();
        runner.poll();
        if (edits % 10 == 0) broken += runner.costs().size() > live.engine().newest().instances().size();
    }
    others.clear();
    runner.stop();
    runner.wait();

    const auto ticks = runner.status().ticks;
    INFO (ticks << " ticks, " << edits << " edits");
    CHECK (broken == 0);
    CHECK (taps.unclean == 0);
    if (wanted) std::cout << ticks << " ticks, " << runner.status().misses << " late, " << edits << " edits, " << recorded
                          << " frames recorded, " << taps.frames.lost() << " lost, " << probed << " probed\n";
}
