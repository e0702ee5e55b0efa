// SPDX-License-Identifier: MIT
#include <tactus/run/realtime.hpp>

#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <optional>
#include <thread>

TEST_CASE ("a sleep does not end early, also if it is shorter than a millisecond", "[run]")
{
    for (const auto pause : { 50, 300, 900, 1500 })
        for (int k = 0; k < 10; ++k)
        {
            const tactus::test::Stopwatch watch;
            tactus::sleepUntil (tactus::test::fromNow (std::chrono::microseconds (pause)));
            CHECK (watch.s() > 1e-6 * (pause - 1));
        }
}

#if defined(__linux__)

#include <pthread.h>
#include <sched.h>

namespace
{
struct Scheduling
{
    int policy = -1, priority = -1;
};

/// The scheduling of a thread after it has asked for a priority. Empty if the request was refused: then the policy must be the same as
/// before.
template <typename Ask>
std::optional<Scheduling> after (Ask&& ask)
{
    std::optional<Scheduling> got;
    std::thread ([&] {
        Scheduling before, now;
        sched_param how {};
        pthread_getschedparam (pthread_self(), &before.policy, &how);
        const bool is_granted = ask();
        pthread_getschedparam (pthread_self(), &now.policy, &how);
        now.priority = how.sched_priority;
        if (is_granted)
            got = now;
        else
            CHECK (now.policy == before.policy);
    }).join();
    return got;
}
}   // namespace

TEST_CASE ("the thread of the emergency stop has a priority above the tick's, and the thread of OSC one below it", "[run][safety]")
{
    CHECK (tactus::priority::stop > tactus::priority::tick);
    CHECK (tactus::priority::messages < tactus::priority::tick);

    const auto tick = after ([] { return tactus::becomeRealTime (std::nullopt).empty(); });
    for (const int wanted : { tactus::priority::stop, tactus::priority::messages })
    {
        const auto got = after ([&] { return ! tactus::raisePriority (wanted); });
        if (! got) continue;   // this user may not use real-time priorities
        CHECK (got->policy == SCHED_FIFO);
        CHECK (got->priority == wanted);
        REQUIRE (tick);
        CHECK (tick->policy == SCHED_FIFO);
        CHECK ((got->priority > tick->priority) == (wanted == tactus::priority::stop));
    }
    CHECK_FALSE (after ([] { return ! tactus::raisePriority (1000); }));   // this priority does not exist
}

#endif
