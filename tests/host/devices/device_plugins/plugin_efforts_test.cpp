// SPDX-License-Identifier: MIT
// Which efforts reach a driver: what it has named, within its limits, and no faster than its slew.
#include "fake_driver.hpp"
#include "support/waiting.hpp"

#include <tactus/run/guard.hpp>

#include <cmath>
#include <limits>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::FakeDriver;
using test::good;

TEST_CASE ("a driver gets only efforts that it has named and limited", "[plugins][safety]")
{
    FakeDriver fake;
    fake.tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_TORQUE;
    fake.guard = R"({"max_torque": "1 N*m", "ramp": "10 ms", "watchdog": "50 ms"})";
    const auto device = fake.open();
    readingOf (*device, fake, good());
    device->write ({});
    readingOf (*device, fake, good());
    REQUIRE (eventually ([&] {
        device->write ({ .force = { 5.0, 0.0, 0.0 }, .torque = { 0.0, 0.0, 0.5 } });
        return fake.lastEffort().torque[2] == 0.5;
    }));
    CHECK (fake.lastEffort().force[0] == 0.0);
    CHECK (readingOf (*device, fake, good()).unrendered_force.x() == 5.0);
}

TEST_CASE ("a driver gets no force along a direction without a motor, and the run is told that it was not rendered", "[plugins][safety]")
{
    FakeDriver fake;
    fake.tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE | TACTUS_DEVICE_TORQUE;
    fake.guard = R"({"max_force": "2 N", "max_torque": "1 N*m", "ramp": "10 ms", "watchdog": "50 ms"})";
    const bool is_old = GENERATE (false, true);   // built before it could name such directions: all are rendered
    if (! is_old) fake.changes = [] (tactus_device_about& about) { about.unrendered = TACTUS_DEVICE_NO_FORCE_Y | TACTUS_DEVICE_NO_TORQUE_X; };
    const auto device = fake.open();
    readingOf (*device, fake, good());
    device->write ({});
    readingOf (*device, fake, good());
    REQUIRE (eventually ([&] {
        device->write ({ .force = { 0.1, 0.2, 0.3 }, .torque = { 0.4, 0.5, 0.6 } });
        return fake.lastEffort().force[0] == 0.1;
    }));
    const auto reading = readingOf (*device, fake, good());
    if (is_old)
    {
        CHECK (Vec3 (fake.lastEffort().force) == Vec3 (0.1, 0.2, 0.3));
        CHECK (reading.unrendered_force == Vec3 (Vec3::Zero()));
        CHECK (reading.unrendered_torque == Vec3 (Vec3::Zero()));
        return;
    }
    CHECK (Vec3 (fake.lastEffort().force) == Vec3 (0.1, 0.0, 0.3));
    CHECK (Vec3 (fake.lastEffort().torque) == Vec3 (0.0, 0.5, 0.6));
    CHECK (reading.unrendered_force == Vec3 (0.0, 0.2, 0.0));
    CHECK (reading.unrendered_torque == Vec3 (0.4, 0.0, 0.0));
}

TEST_CASE ("a driver learns that a stop withholds the effort, and the strictest limit of signals", "[plugins][safety]")
{
    FakeDriver fake;
    fake.signal_outputs = 2;
    fake.guard = R"({"max_force": "2 N", "max_signal": 1, "ramp": "10 ms", "watchdog": "50 ms"})";
    const auto device = fake.open();
    const auto gets = [&] (double newtons) {
        device->write ({ .force = { newtons, 0.0, 0.0 } });
        return eventually ([&] { return fake.lastEffort().force[0] == newtons; });
    };
    device->read();
    device->write ({});
    REQUIRE (gets (0.1));
    CHECK (fake.lastEffort().is_withheld == 0u);
    CHECK (fake.lastEffort().max_signal == 1.0);
    device->limitSignals (0.2, GuardLimits::none);
    device->withhold();
    REQUIRE (gets (0.2));
    CHECK (fake.lastEffort().is_withheld == 1u);
    CHECK (fake.lastEffort().max_signal == 0.2);
    device->limitSignals (5.0, GuardLimits::none);
    REQUIRE (gets (0.3));
    CHECK (fake.lastEffort().is_withheld == 0u);
    CHECK (fake.lastEffort().max_signal == 1.0);
}

TEST_CASE ("on the way to a driver, no force changes faster than its slew by the wall clock, however long a write takes", "[plugins][safety]")
{
    constexpr double slew = 20.0;
    FakeDriver fake;
    fake.guard = R"({"max_force": "2 N", "max_slew": "20 N/s", "ramp": "10 ms", "watchdog": "50 ms"})";
    const auto device = fake.open();
    device->limitSlews (GuardLimits::none, GuardLimits::none, GuardLimits::none);   // as if the guard had none
    device->read();
    device->write ({});
    for (int k = 0; k < 150; ++k)
    {
        device->read();
        device->write ({ .force = { k % 50 < 25 ? 2.0 : -2.0, 0.0, 0.0 } });
        test::letPass (k % 7 == 0 ? 8ms : 1ms);
    }
    const auto all = fake.told();
    double most = 0.0;
    for (std::size_t i = 3; i + 1 < all.size(); ++i)
    {
        REQUIRE (all[i].what == "force");
        if (all[i + 1].what != "force") break;
        // The limiter reads the clock before the driver does, but after the write before.
        const double passed = all[i + 1].at_s - all[i - 1].at_s;
        CHECK (std::abs (all[i + 1].force - all[i].force) <= slew * passed + 1e-9);
        most = std::max (most, std::abs (all[i + 1].force));
    }
    CHECK (most > 0.1);
    CHECK (device->read().unrendered_force.norm() > 0.0);
}
