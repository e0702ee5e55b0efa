// SPDX-License-Identifier: MIT
#include "support/no_allocation.hpp"
#include "support/waiting.hpp"

#include <host/base/platform/doorbell.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <thread>

using tactus::host::Doorbell;
using tactus::test::fromNow;
using namespace std::chrono_literals;

TEST_CASE ("several rings before a wait count as one", "[platform]")
{
    Doorbell bell;
    CHECK_FALSE (bell.wait (fromNow (0ms)));
    for (int i = 0; i < 3; ++i)
        bell.ring();
    CHECK (bell.wait (fromNow (0ms)));
    CHECK_FALSE (bell.wait (fromNow (1ms)));
    bell.ring();
    CHECK (bell.wait (fromNow (10s)));
}

TEST_CASE ("a million rings take no lock, allocate nothing, and none is lost", "[platform][threads]")
{
    constexpr int rings = 1'000'000;
    Doorbell bell;
    std::atomic<int> announced = 0, locks = 0, allocations = 0;
    std::jthread ringer ([&] {
        const NoAllocation watch;
        for (int i = 1; i <= rings; ++i)
        {
            announced.store (i, std::memory_order_relaxed);
            bell.ring();
        }
        locks = watch.locks();
        allocations = watch.allocations();
    });

    // After the wait that the last ring ends, the last number is seen. If that ring were lost, the wait would never end.
    int seen = 0;
    bool silent = false;
    for (; seen < rings && ! silent; seen = announced.load (std::memory_order_relaxed))
        silent = ! bell.wait (fromNow (60s));
    ringer.join();
    CHECK_FALSE (silent);
    CHECK (seen == rings);
    CHECK (locks == 0);
    CHECK (allocations == 0);
}

TEST_CASE ("two threads take turns through two doorbells", "[platform][threads]")
{
    constexpr int turns = 20'000;
    Doorbell there, back;
    int shared = 0;   // not atomic: the doorbells order the accesses
    std::jthread other ([&] {
        for (int i = 0; i < turns && there.wait (fromNow (60s)); ++i)
        {
            ++shared;
            back.ring();
        }
    });
    int answered = 0;
    for (; answered < turns; ++answered)
    {
        ++shared;
        there.ring();
        if (! back.wait (fromNow (60s))) break;
    }
    other.join();
    CHECK (answered == turns);
    CHECK (shared == 2 * turns);
}
