// SPDX-License-Identifier: GPL-3.0-or-later
#include <tactus/run/tick_clock.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <functional>
#include <thread>

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
    AbsoluteTimer timer { period };
    const double begin = timer.now();
    double least = begin;
    int k = 0;
    bool early = false, negative = false;
    Each each { [&] (double late) {
        const double now = timer.now();
        negative = negative || late < 0.0;
        early = early || now < least - 1e-6;
        least = now - late + period;
        if (k == 20) std::this_thread::sleep_for (std::chrono::milliseconds (20));
        if (late > period) least = now - 1e-3;   // the timer restarts from here, give or take the time between two clock reads
        return ++k < 50;
    } };
    timer.drive (each);
    CHECK (k == 50);
    CHECK_FALSE (negative);
    CHECK_FALSE (early);
    CHECK (timer.now() - begin > 0.04);
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
