// SPDX-License-Identifier: MIT
#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/run/clock/tick_account.hpp>
#include <tactus/run/probe_ring.hpp>

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <thread>

using namespace tactus;

namespace
{
/// A plan whose first two taps count the ticks, from 1.
std::shared_ptr<Plan> counter()
{
    test::Sketch s;
    s.node ("one", "signal.constant", { { "value", 1.0 } }).node ("count", "signal.add").node ("again", "signal.gain");
    s.wire ("one.out -> count.in[0]").wire ("count.out -> [1] -> count.in[1]").wire ("count.out -> again.in");
    const auto plan = s.compile ({ .records = { "count.out", "again.out", "one.out" } }).plan;
    REQUIRE (plan);
    return plan;
}
}   // namespace

TEST_CASE ("the selected taps are captured in order, every n-th tick, and frames that are not drained are lost", "[probe]")
{
    const auto plan = counter();
    ProbeRing ring;
    const auto run = [&] (std::uint64_t from, std::uint64_t to) {
        for (auto k = from; k < to; ++k)
        {
            plan->tick();
            ring.note (*plan, k);
        }
        std::vector<ProbeRing::Frame> frames;
        ring.drain ([&] (const auto& frame) { frames.push_back (frame); });
        return frames;
    };
    CHECK (run (0, 10).empty());

    const std::size_t taps[] { 2, 0, 99 };
    ring.select (taps, 4);
    const auto frames = run (10, 100);
    REQUIRE (frames.size() == 22);
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
        CHECK (frames[i].plan == plan->serial());
        CHECK (frames[i].tick == 12 + 4 * i);
        CHECK (frames[i].size == 3);
        CHECK (frames[i].values[0] == 1.0);
        CHECK (frames[i].values[1] == static_cast<double> (frames[i].tick + 1));
    }
    ring.select (taps, 1);
    const auto many = run (100, 5000);
    CHECK (many.size() > 1000);
    CHECK (many.size() < 4900);
    CHECK (many.front().tick == 100);
    ring.select ({}, 1);
    CHECK (run (5000, 5100).empty());
}

TEST_CASE ("the work of the tick thread outside the tick allocates nothing and takes no lock", "[probe]")
{
    const auto plan = counter();
    ProbeRing ring;
    SpscRing<double> frames { 16, 3 };
    TickAccount account { 1e-3 };
    const std::size_t taps[] { 0, 1 };
    ring.select (taps, 1);
    const NoAllocation watch;
    for (std::uint64_t k = 0; k < 3000; ++k)   // continues after the rings are full
    {
        ring.note (*plan, k);
        account.note (1e-6, 1e-5);
        frames.claim();
        frames.commit();
    }
    const int allocations = watch.allocations(), locks = watch.locks();
    CHECK (allocations == 0);
    CHECK (locks == 0);
    CHECK (frames.lost() > 0);
}

TEST_CASE ("frames arrive complete and in order while the selection changes, and the tick never waits", "[probe]")
{
    const auto plan = counter();
    ProbeRing ring;
    std::atomic<bool> done { false };
    std::thread ticking ([&] {
        for (std::uint64_t k = 0; k < 50000; ++k)
        {
            plan->tick();
            ring.note (*plan, k);
        }
        done = true;
    });
    std::size_t broken = 0;
    std::uint64_t last = 0;
    const std::size_t taps[] { 0, 1 };
    for (std::uint32_t i = 0; ! done; ++i)
    {
        ring.select (std::span (taps).first (1 + i % 2), 1 + i % 3);
        ring.drain ([&] (const ProbeRing::Frame& f) {
            for (std::size_t v = 0; v < f.size; ++v)
                broken += f.values[v] != static_cast<double> (f.tick + 1);
            broken += f.tick < last;
            last = f.tick;
        });
    }
    ticking.join();
    CHECK (broken == 0);
}

TEST_CASE ("the parts of a port are its components and entries, in every instance that it addresses", "[runtime]")
{
    CHECK (isPartOf ("drag.force", "drag.force"));
    CHECK (isPartOf ("drag.force.x", "drag.force"));
    CHECK_FALSE (isPartOf ("drag.forced", "drag.force"));
    CHECK (isPartOf ("mix.in[0]", "mix.in"));
    for (const auto* port : { "finger.force", "finger[*].force", "finger[12].force" })
        CHECK (isPartOf ("finger[12].force.x", port));
    CHECK_FALSE (isPartOf ("finger[12].force.x", "finger[1].force"));
    CHECK (isPartOf ("hand[1]/finger[0]/mix.in[2]", "hand[1]/finger/mix.in"));
    CHECK_FALSE (isPartOf ("hand[1]/finger[0]/mix.in[2]", "hand[2]/finger/mix.in"));
    CHECK_FALSE (isPartOf ("hand[1]/finger[0]/mix.in[2]", "hand.in"));
}
