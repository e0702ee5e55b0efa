// SPDX-License-Identifier: GPL-3.0-or-later
// All threads that a live run has at once. What TSan is to look at; TACTUS_LIVE_SECONDS makes it longer.

#include <host/runtime/frame_ring.hpp>
#include <host/runtime/probe_ring.hpp>
#include <host/runtime/runner.hpp>

#include "support/chance_hand.hpp"
#include "support/no_allocation.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include <framework/live.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdlib>
#include <iostream>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr double rate_hz = 4000.0;

/// Counts the ticks, has a parameter that is turned, something that is steadily felt, and something that is edited.
test::Sketch sketched()
{
    test::Sketch s { test::besides (test::prefixed (test::randomGraph (5, 20), "s_", "left"), test::prefixed (test::randomGraph (6, 30), "e_", "right")) };
    s.node ("s_hand", "device.position").node ("s_wall", "deform.plane").node ("s_motor", "device.force").wire ("s_hand.position -> s_wall.position").wire ("s_wall.force -> s_motor.force");
    s.node ("one", "signal.constant", { { "value", 1.0 } }).node ("count", "signal.add").node ("turned", "signal.gain");
    return s.wire ("one.out -> count.in[0]").wire ("count.out -> [1] -> count.in[1]").wire ("one.out -> turned.in");
}

/// What is recorded and probed of a run: the first tap counts, the second is turned.
class Taps final : public TickHooks
{
public:
    explicit Taps (Engine& e) : engine (e) {}

    void before (std::uint64_t) noexcept override { watch.emplace(); }
    void after (std::uint64_t tick, bool) noexcept override
    {
        probes.note (engine.plan(), tick);
        if (const auto frame = frames.next(); ! frame.empty())
        {
            for (std::size_t i = 0; i < frame.size(); ++i)
                frame[i] = *engine.plan().taps[i].value;
            frames.push();
        }
        unclean += watch->allocations() + watch->locks();
        watch.reset();
    }

    FrameRing frames { 2, 4096 };
    ProbeRing probes;
    int unclean = 0;   ///< allocations, frees and locks of all ticks

private:
    Engine& engine;
    std::optional<NoAllocation> watch;
};
}   // namespace

TEST_CASE ("an editor, a hand on a knob, a probe reader, a recorder and whoever wants to know how it goes do not get in the way of a run", "[runtime]")
{
    const auto sketch = sketched();
    const CompileOptions options { .rate_hz = rate_hz, .records = { "count.out", "turned.out" } };
    const auto first = sketch.compile (options);
    INFO (test::text (first.messages));
    REQUIRE (first.plan);
    Live live { sketch.graph, catalogue(), options, first.plan };
    test::ChanceHand hand { 1 };
    live.engine().attach ("stylus", hand);
    const auto gain = std::get<plan::ParamRef> (live.engine().param ("turned.gain"));

    Taps taps { live.engine() };
    const std::size_t all[] { 0, 1 };
    taps.probes.select (all, 3);
    AbsoluteTimer clock { 1.0 / rate_hz };
    Runner runner { live.engine(), clock, rate_hz, { .hooks = &taps } };
    runner.start();

    std::atomic<std::uint64_t> probed = 0, recorded = 0, looked = 0;
    std::atomic<int> broken = 0;
    std::vector<std::jthread> others;
    const auto beside = [&] (auto what)
    {
        others.emplace_back ([what] (const std::stop_token& over) mutable
                             {
            for (; ! over.stop_requested(); std::this_thread::yield())
                what(); });
    };
    beside ([&, i = 0]() mutable
            { live.engine().set (gain, i++ % 100); });
    beside ([&]
            { taps.probes.drain ([&] (const ProbeRing::Frame& f)
                                 {
            broken += f.size != 2 || f.tick % 3 != 0 || f.values[0] != static_cast<double> (f.tick + 1);
            ++probed; }); });
    beside ([&, last = 0.0]() mutable
            { taps.frames.drain ([&] (std::span<const double> f)
                                 {
            broken += ! (f[0] > last) || ! (f[1] >= 0.0 && f[1] < 100.0);
            last = f[0];
            ++recorded; }); });
    beside ([&, last = RunStatus {}]() mutable
            {
        const auto now = runner.status();
        broken += now.ticks < last.ticks || now.peak < now.force || (now.ticks > 0 && now.shown().empty()) || runner.account().lateness().quantile (0.99) < 0.0;
        last = now;
        ++looked; });

    std::mt19937 random { 7 };
    const auto* wanted = std::getenv ("TACTUS_LIVE_SECONDS");
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds (wanted ? 1000 * std::atoi (wanted) : 500);
    int edits = 0;
    for (; std::chrono::steady_clock::now() < end; ++edits)
    {
        if (live.history().position() > 50)
            while (live.history().position() > 0)
                live.undo();
        auto messages = live.perform (test::randomEdit (random, live.graph(), "e_", "right"));
        while (hasErrors (messages))
            messages = live.undo();
        runner.attend();
        if (edits % 10 == 0) broken += runner.costs().size() > live.engine().newest().instances.size();
    }
    others.clear();
    runner.stop();
    runner.wait();

    const auto ticks = runner.status().ticks;
    INFO (ticks << " ticks, " << edits << " edits");
    CHECK (broken == 0);
    CHECK (taps.unclean == 0);
    CHECK (edits > 10);
    CHECK (probed > 10);
    CHECK (recorded > 10);
    CHECK (looked > 10);
    if (wanted) std::cout << ticks << " ticks, " << runner.status().misses << " late, " << edits << " edits, " << recorded << " frames recorded, " << taps.frames.lost() << " lost, " << probed << " probed\n";
}
