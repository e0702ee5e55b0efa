// SPDX-License-Identifier: MIT
// How a device learns that its guard withholds efforts.
#include "support/sketch.hpp"

#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <string>
#include <utility>

using namespace tactus;
using test::Sketch;

namespace
{
/// Notes the calls of each tick: w for withhold, e for an effort, 0 for none.
struct Noting final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return reading; }
    void write (const Effort& e) noexcept override { calls += e.force.norm() < 1e-9 ? '0' : 'e'; }
    void withhold() noexcept override { calls += 'w'; }

    Reading reading;
    std::string calls;

    std::string take() { return std::exchange (calls, {}); }
};
}   // namespace

TEST_CASE ("a device is told before each effort of a stop that the guard withholds, whatever the cause, and at no other time", "[live][guard]")
{
    Sketch sketch;
    sketch.node ("push", "signal.constant", { { "value", 2.0 } }).node ("motor", "device.force").wire ("push.out -> motor.force.x");
    const auto [plan, messages] = sketch.compile ({ .rate_hz = 1000.0 });
    INFO (test::text (messages));
    REQUIRE (plan);
    Engine engine { plan };
    Noting device;
    engine.attach ("stylus", device);
    device.take();
    const auto ticks = [&] (int count) {
        for (int k = 0; k < count; ++k)
            engine.tick();
        return device.take();
    };
    CHECK (ticks (3) == "eee");
    device.reading.valid = false;
    CHECK (ticks (7) == "wewewewew0w0w0");   // 5 ms of fade
    device.reading.valid = true;
    CHECK (ticks (2) == "ee");
    engine.emergencyStop();
    CHECK (ticks (6) == "wewewewew0w0");
    engine.rearm();
    CHECK (ticks (2) == "ee");
}
