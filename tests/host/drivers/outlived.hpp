// SPDX-License-Identifier: MIT
#pragma once

#include "support/waiting.hpp"

#include <host/cli/running.hpp>

#include <catch2/catch.hpp>

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tactus::test
{

/// The time of the steady clock, in ns, by which fakes say when something has happened.
inline std::int64_t steadyNow() { return std::chrono::nanoseconds (fromNow (std::chrono::nanoseconds (0)).time_since_epoch()).count(); }

/// The time in which this computer had a processor to spare. A thread that gives way to all others takes short naps: a nap that takes longer than it should
/// counts as one that does not. So what waits for a processor does not count, as far as others, and the computer below a virtual one, are the cause.
class SpareTime
{
public:
    SpareTime()
    {
        napping = std::thread ([this] {
            const sched_param none {};
            static_cast<void> (::sched_setscheduler (0, SCHED_IDLE, &none));   // of this thread
            for (auto before = steadyNow(); ! is_over;)
            {
                letPass (nap);
                const auto now = steadyNow();
                const std::lock_guard lock (mutex);
                naps.push_back ({ now, std::min (now - before, longest_nap_ns) });
                before = now;
            }
        });
    }
    ~SpareTime()
    {
        is_over = true;
        napping.join();
    }
    SpareTime (const SpareTime&) = delete;
    SpareTime& operator= (const SpareTime&) = delete;

    /// The spare time between two times of the steady clock, in ms.
    double between (std::int64_t from, std::int64_t to)
    {
        eventually ([&] {
            const std::lock_guard lock (mutex);
            return ! naps.empty() && naps.back().end >= to;
        });
        const std::lock_guard lock (mutex);
        double ns = 0.0;
        for (const auto& each : naps)
            if (each.end > from) ns += static_cast<double> (std::clamp<std::int64_t> (to - (each.end - each.counted), 0, each.counted));
        return 1e-6 * ns;
    }

private:
    struct Nap
    {
        std::int64_t end, counted;
    };
    static constexpr std::chrono::microseconds nap { 200 };
    static constexpr std::int64_t longest_nap_ns = 400'000;
    std::atomic<bool> is_over = false;
    std::mutex mutex;
    std::vector<Nap> naps;
    std::thread napping;
};

/// An end of a program that plays on a fake, and the longest time for which a force may outlive it.
struct End
{
    const char* what;
    double promise_ms;
    int signal = 0;                            // to the program; 0: none
    std::function<void()> otherwise = [] {};   // what happens then, such as a pulled cable
};

/// True if a force on a fake outlives an end no longer than promised, in spare time of the computer. What waits in the wrong moment makes that longer, too,
/// so the end is tried again until it is short enough, 5 times at most: it is never short enough if what should take the force off does not. Prints the
/// times. `zero`: the time at which the fake has lost its force since then, or 0; -1 if it had none then.
template <typename Pushes, typename Zero>
bool keepsPromise (const std::vector<std::string>& play, const End& end, Pushes&& pushes, Zero&& zero)
{
    double shortest = std::numeric_limits<double>::infinity(), by_clock = 0.0;
    int tries = 0;
    for (; shortest > end.promise_ms && tries < 5; ++tries)
    {
        SpareTime spare;
        Running program (play);
        REQUIRE (soon (pushes));
        letPass (std::chrono::milliseconds (300));   // the ramp
        REQUIRE (soon (pushes));
        const auto begin = steadyNow();
        if (end.signal != 0) program.signal (end.signal);
        end.otherwise();
        std::int64_t at = 0;
        REQUIRE (eventually ([&] { return (at = zero (begin)) > begin || at < 0; }));
        if (at > begin)   // else the hand had just left the wall, so there was no force to outlive the end
        {
            shortest = std::min (shortest, spare.between (begin, at));
            by_clock = 1e-6 * static_cast<double> (at - begin);
        }
        if (end.signal == SIGSTOP) program.signal (SIGCONT);
        static_cast<void> (end.signal == SIGKILL ? program.finish() : program.stop());
    }
    std::cout << play[3] << ", " << end.what << ": the force is zero after " << shortest << " ms of spare time (" << by_clock << " ms by the clock), promised "
              << end.promise_ms << " ms, try " << tries << "\n";
    return shortest <= end.promise_ms;
}

}   // namespace tactus::test
