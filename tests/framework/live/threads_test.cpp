// SPDX-License-Identifier: MIT
// Edits, turned knobs and ticks at the same time, for TSan. TACTUS_LIVE_SECONDS makes it longer.

#include "support/chance_hand.hpp"
#include "support/no_allocation.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

using namespace tactus;

// Long because it is one scenario: three threads share an engine, and the final checks use their counts.
TEST_CASE ("a graph that is edited and turned from other threads keeps ticking, and untouched parts remain bit-identical", "[live]")
{
    auto steady = test::prefixed (test::randomGraph (5, 20), "s_", "left"), wild = test::prefixed (test::randomGraph (6, 30), "e_", "right");
    test::Sketch sketch { test::sideBySide (std::move (steady), std::move (wild)) };
    sketch.node ("s_hand", "device.position")
        .node ("s_wall", "deform.plane")
        .node ("s_motor", "device.force")
        .wire ("s_hand.position -> s_wall.position")
        .wire ("s_wall.force -> s_motor.force");
    sketch.node ("e_amp", "signal.gain").node ("turned", "signal.gain").node ("one", "signal.constant", { { "value", 1.0 } }).wire ("one.out -> turned.in");
    const CompileOptions options { .rate_hz = 4000.0, .records = { "turned.out" } };
    const auto first = sketch.compile (options);
    INFO (test::text (first.messages));
    REQUIRE (first.plan);
    test::Live live { sketch.graph, catalogue(), options, first.plan };
    const auto turned = *live.engine().param ("turned.gain");

    test::ChanceHand hand { 1 };
    live.engine().attach ("stylus", hand);

    std::atomic<bool> stop = false;
    std::atomic<int> taken = 0, unclean = 0;
    std::uint64_t ticks = 0;
    std::thread ticker { [&] {
                             const Plan* last = nullptr;
                             for (; ! stop; ++ticks)
                             {
                                 {
                                     const NoAllocation watch;
                                     live.engine().tick();
                                     unclean += watch.allocations() + watch.locks();
                                 }
                                 if (last != &live.engine().plan()) ++taken;
                                 last = &live.engine().plan();
                                 if (ticks % 16 == 0) std::this_thread::yield();
                             } } };
    std::thread turner { [&] {
                             for (int i = 0; ! stop; ++i)
                             {
                                 live.engine().set (turned, i % 100);
                                 std::this_thread::yield();
                             } } };

    std::mt19937 random { 7 };
    const auto* wanted = std::getenv ("TACTUS_LIVE_SECONDS");
    const std::chrono::milliseconds least { wanted ? 1000 * std::stoi (wanted) : 500 };
    const test::Stopwatch watch;
    std::size_t most_kept = 0;
    for (int i = 0; taken < 2 || ! watch.hasRun (least); ++i)   // a busy machine may hold the ticking thread back
    {
        if (live.history().position() > 50)
            while (live.history().position() > 0)
                live.undo();
        auto messages = live.perform (test::randomEdit (random, live.graph(), "e_", "right"));
        while (hasErrors (messages))
            messages = live.undo();
        if (i % 5 == 0) static_cast<void> (live.set ("e_amp.gain", 0.1 * (i % 7)));   // an edit may have removed the node
        most_kept = std::max (most_kept, live.engine().clear());
    }
    stop = true;
    ticker.join();
    turner.join();

    CHECK (taken > 1);
    CHECK (unclean == 0);
    CHECK (most_kept <= 3);
    Engine alone { sketch.compile (options).plan };
    test::ChanceHand other { 1 };
    alone.attach ("stylus", other);
    for (std::uint64_t k = 0; k < ticks; ++k)
        alone.tick();
    INFO (ticks << " ticks, " << taken << " plans");
    CHECK (hand.digest == other.digest);
    if (wanted) std::cout << ticks << " ticks, " << taken << " plans taken\n";
    live.engine().set (turned, 3.0);
    for (int k = 0; k < 200; ++k)
        live.engine().tick();
    CHECK (*live.engine().plan().taps()[0].value == 3.0);
}
