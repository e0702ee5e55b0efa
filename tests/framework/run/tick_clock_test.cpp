// SPDX-License-Identifier: MIT
#include <tactus/run/tick_clock.hpp>

#include <tactus/run/clock/passed_time.hpp>

#include "support/tick_thread_locks.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

using namespace tactus;

namespace
{
struct Each final : Ticked
{
    explicit Each (std::function<bool (double)> f) : what (std::move (f)) {}
    bool tick (double late_s) noexcept override { return what (late_s); }

    std::function<bool (double)> what;
};
}   // namespace

TEST_CASE ("an absolute timer never begins a tick early, and does not catch up on missed ticks", "[runtime]")
{
    constexpr double period = 1e-3;
    AbsoluteTimer timer { period, GENERATE (AbsoluteTimer::Wait::punctual, AbsoluteTimer::Wait::idle) };
    const double begin = timer.now();
    double least = begin;   // the deadline is this or later, however long the clock's reads are apart
    int k = 0;
    bool early = false, negative = false;
    Each each { [&] (double late) {
        const double now = timer.now();
        negative = negative || late < 0.0;
        early = early || now < least - 1e-6;
        if (late > period) least += late;   // the timer restarts when it notices
        least += period;
        if (k == 20) test::letPass (std::chrono::milliseconds (20));
        return ++k < 50;
    } };
    timer.drive (each);
    CHECK (k == 50);
    CHECK_FALSE (negative);
    CHECK_FALSE (early);
    CHECK (timer.now() - begin > 0.04);
}

TEST_CASE ("ticks of simulated devices are due together a millisecond at a time, and none begins before its millisecond", "[runtime]")
{
    for (const auto& row : { std::pair { 4000.0, 4 }, { 20e3, 20 }, { 1000.0, 1 }, { 500.0, 1 }, { 1500.0, 1 } })
    {
        const double rate_hz = row.first;
        const int together = row.second;
        AbsoluteTimer timer { 1.0 / rate_hz, AbsoluteTimer::Wait::idle };
        const double begin = timer.now();
        std::vector<double> lates;
        int k = 0, early = 0;
        Each each { [&] (double late) {
            const double ms = (k - k % together) / rate_hz;
            early += timer.now() < begin + ms - 1e-6;
            lates.push_back (late);
            return ++k < 10 * together;
        } };
        timer.drive (each);
        INFO (rate_hz);
        CHECK (early == 0);
        CHECK (k == 10 * together);
        // The thread waits once for all of them, and each is due a period after the one before.
        for (std::size_t i = 0; i < lates.size(); ++i)
        {
            const auto after = i % static_cast<std::size_t> (together);
            CHECK (lates[i] == Approx (std::max (0.0, lates[i - after] - static_cast<double> (after) / rate_hz)).margin (1e-12));
        }
        CHECK (timer.block_s() == (together > 1 ? together / rate_hz : 0.0));
    }
}

TEST_CASE ("for the limits of a simulated device, ticks that are due together are a period apart", "[runtime]")
{
    constexpr double period = 1e-4;
    AbsoluteTimer timer { period, AbsoluteTimer::Wait::idle };
    PassedTime passed { period };
    double passed_s = 0.0, longest = 0.0;
    for (int k = 0; k < 1000; ++k)
    {
        const int milliseconds = k / 10;
        const double p = passed (1e-3 * milliseconds, timer.block_s());
        longest = std::max (longest, p);
        if (k >= 10) CHECK (p == Approx (period));   // at the beginning, only one period has passed
        passed_s += p;
    }
    CHECK (longest <= period * (1.0 + 1e-9));
    CHECK (passed_s == Approx (0.0991));
}

TEST_CASE ("a free run ticks until a tick returns that it was the last one", "[runtime]")
{
    int k = 0;
    double latest = 0.0;
    Each each { [&] (double late) {
        latest = std::max (latest, late);
        return ++k < 1000;
    } };
    FreeRun {}.drive (each);
    CHECK (k == 1000);
    CHECK (latest == 0.0);
    CHECK_FALSE (FreeRun {}.isRealTime());
}

TEST_CASE ("ticks of a timer and of a free run take no locks, and neither does the wait between them", "[runtime][clocks]")
{
    AbsoluteTimer timer { 1e-3, GENERATE (AbsoluteTimer::Wait::punctual, AbsoluteTimer::Wait::idle) };
    test::checkThatTicksLockNothing (timer, nullptr, 200, [] { test::letPass (std::chrono::milliseconds (1)); });
    FreeRun free;
    test::checkThatTicksLockNothing (free, nullptr, 2000, [] { std::this_thread::yield(); });
}

TEST_CASE ("a clock whose thread takes a lock between ticks is found out", "[runtime][clocks]")
{
    if constexpr (NoAllocation::watches)
    {
        struct Locking final : TickClock
        {
            void drive (Ticked& ticked) noexcept override
            {
                for (bool goes_on = true; goes_on;)
                {
                    const std::lock_guard lock (mutex);
                    goes_on = ticked.tick (0.0);
                }
            }
            bool isRealTime() const noexcept override { return false; }
            std::mutex mutex;
        };
        Locking clock;
        Engine engine { test::Sketch {}.node ("a", "signal.constant").compile ({ .rate_hz = 1000.0 }).plan };
        test::CountLocks counted { 10 };
        Runner runner { engine, clock, 1000.0, { .length = 20, .hooks = &counted } };
        runner.start();
        runner.wait();
        CHECK (counted.is_over);
        CHECK (counted.locks == 10);
    }
}
