// SPDX-License-Identifier: MIT
// A sound card as the clock of a run.

#include "support/sketch.hpp"
#include "support/tick_thread_locks.hpp"
#include "support/waiting.hpp"

#include <host/devices/audio/audio_clock.hpp>
#include <support/property.hpp>
#include <tactus/run/runner.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using namespace std::chrono_literals;
using audio::AudioClock;

namespace
{
struct Counted final : Ticked
{
    bool tick (double) noexcept override { return ++count < most; }
    std::atomic<int> count = 0;
    int most = 1 << 30;
};

/// A device that records the force it gets, and the largest step of that force.
struct Pushed final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override
    {
        const double f = e.force.norm();
        largest_step = std::max (largest_step, std::abs (f - force.load()));
        force = f;
        ++ticks;
    }
    std::atomic<double> force = 0.0;
    std::atomic<int> ticks = 0;
    double largest_step = 0.0;
};

/// A card whose ticks are one period apart, however busy the machine is.
struct EvenClock final : AudioClock
{
    EvenClock (double hz, const Pushed& d) : AudioClock (hz), device (d), rate (hz) {}
    double now() const noexcept override { return device.ticks / rate; }

    const Pushed& device;
    const double rate;
};

}   // namespace

TEST_CASE ("blocks trigger as many ticks as fit into their length, at any rates", "[audio]")
{
    test::property ("no tick is lost or invented", [] {
        const double tick_hz = *rc::gen::element (500.0, 1000.0, 4000.0, 44'100.0, 48'000.0), card_hz = *rc::gen::element (44'100.0, 48'000.0);
        AudioClock clock { tick_hz };
        Counted ticked;
        std::jthread driver ([&] { clock.drive (ticked); });
        int frames = 0;
        while (ticked.count == 0)   // waits until the clock is driven
        {
            clock.block (1000, card_hz);
            std::this_thread::yield();
        }
        const int before = ticked.count;
        for (int k = 0; k < 200; ++k)
        {
            const int n = *rc::gen::inRange (1, 600);
            clock.block (n, card_hz);
            frames += n;
        }
        const int ticks = ticked.count - before;
        RC_ASSERT (clock.ticksByTimer() == 0u);
        ticked.most = 0;
        clock.block (10'000, card_hz);
        RC_ASSERT (std::abs (ticks - frames * tick_hz / card_hz) <= 1.001);
    });
}

TEST_CASE ("if the card that ticks the run goes away, a timer ticks with all forces at zero, and when the card is back, they ramp up", "[audio][safety]")
{
    constexpr double rate_hz = 1000.0, ramp_s = 0.05;
    const auto sketch = test::Sketch {}
                            .node ("push", "signal.constant", { { "value", 2.0 } })
                            .node ("join", "vector.join")
                            .node ("motor", "device.force")
                            .wire ("push.out -> join.z")
                            .wire ("join.out -> motor.force");
    Engine engine { sketch.compile ({ .rate_hz = rate_hz }).plan };
    Pushed device;
    engine.attach ("stylus", device, { .ramp = ramp_s });
    EvenClock clock { rate_hz, device };
    Runner runner { engine, clock, rate_hz, {} };

    std::atomic<bool> plays = true;
    std::jthread card ([&] (const std::stop_token& stop) {
        while (! stop.stop_requested())
        {
            if (plays) clock.block (96, 48'000.0);
            test::letPass (1ms);
        }
    });
    runner.start();
    REQUIRE (test::eventually ([&] { return device.force == 2.0; }));
    CHECK_FALSE (runner.status().clock_replaced);

    plays = false;
    REQUIRE (test::eventually ([&] { return runner.status().clock_replaced && device.force == 0.0; }));
    CHECK (runner.status().phase == RunStatus::Phase::running);
    const auto ticks = runner.status().ticks;
    CHECK (test::eventually ([&] { return runner.status().ticks > ticks + 20; }));
    CHECK (device.force == 0.0);
    CHECK (clock.ticksByTimer() > 20);

    plays = true;
    REQUIRE (test::eventually ([&] { return device.force == 2.0; }));
    CHECK_FALSE (runner.status().clock_replaced);
    runner.stop();
    CHECK (test::eventually ([&] { return runner.isOver(); }));
    CHECK (device.force == 0.0);
    CHECK (device.largest_step <= 2.0 / (Guard::fade_s * rate_hz) + 1e-9);
}

TEST_CASE ("a run ticked by a card stops on request even if no block ever arrives", "[audio]")
{
    Engine engine { test::Sketch {}.node ("a", "signal.constant").compile ({ .rate_hz = 1000.0 }).plan };
    AudioClock clock { 1000.0 };
    Runner runner { engine, clock, 1000.0, {} };
    runner.start();
    REQUIRE (test::eventually ([&] { return clock.ticksByTimer() > 3; }));
    runner.stop();
    CHECK (test::eventually ([&] { return runner.isOver(); }));
}

TEST_CASE ("ticks of a sound card take no locks, on the card's thread and on that of the timer that stands in", "[audio][clocks]")
{
    AudioClock played { 1000.0 }, silent { 1000.0 };
    test::checkThatTicksLockNothing (played, nullptr, 200, [&] {
        played.block (48, 48'000.0);
        test::letPass (1ms);
    });
    test::checkThatTicksLockNothing (silent, nullptr, 50, [] { test::letPass (1ms); });
}
