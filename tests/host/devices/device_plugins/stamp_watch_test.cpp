// SPDX-License-Identifier: MIT
// Readings that look good, but that the number or the clock of the device gives away.
#include <host/devices/device_plugins/stamp_watch.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using host::StampWatch;

namespace
{
/// A device at 1 kHz, with a number and a clock of its own.
struct Device
{
    StampWatch watch { 1000.0 };
    std::uint64_t number = 0;
    double wall = 100.0, clock = 7.0;

    StampWatch::Assessment next (double passed = 1e-3, double on_its_clock = 1e-3)
    {
        wall += passed;
        clock += on_its_clock;
        return watch ({ sizeof (tactus_device_stamp), 0, ++number, clock, 0.0 }, wall);
    }
};
}   // namespace

TEST_CASE ("good readings are new and not late, also if the clock of the device is not exact and readings come in batches", "[plugins]")
{
    for (const double speed : { 0.9992, 1.0, 1.0008 })
    {
        Device device;
        double worst = 0.0;
        for (int k = 0; k < 20'000; ++k)
        {
            const auto v = device.next (k % 4 == 3 ? 4e-3 : 0.0, speed * 1e-3);
            CHECK (v.is_new);
            CHECK (v.fault == ReadingFault::none);
            worst = std::max (worst, v.lag_s);
        }
        CHECK (worst < 5e-3);
    }
}

TEST_CASE ("a reading with the same number or the same time is not a new one", "[plugins][safety]")
{
    Device device;
    device.next();
    --device.number;
    auto v = device.next();
    CHECK_FALSE (v.is_new);
    CHECK (v.fault == ReadingFault::repeated);
    v = device.next();
    CHECK (v.is_new);
    v = device.next (1e-3, 0.0);
    CHECK_FALSE (v.is_new);
    CHECK (v.fault == ReadingFault::clock_stopped);
}

TEST_CASE ("after a number or a time that goes back, 16 good readings must follow", "[plugins][safety]")
{
    for (const bool by_number : { true, false })
    {
        Device device;
        for (int k = 0; k < 40; ++k)
            device.next();
        if (by_number) device.number = 3;
        auto v = device.next (1e-3, by_number ? 1e-3 : -0.5);
        CHECK (v.has_gone_back);
        CHECK (v.fault == ReadingFault::restarted);
        int until = 0;
        while (device.next().fault == ReadingFault::restarted)
            ++until;
        CHECK (until == 15);
        CHECK (device.next().fault == ReadingFault::none);
    }
}

TEST_CASE ("when more than half of the readings are missing, none is trusted", "[plugins][safety]")
{
    SECTION ("by their numbers")
    {
        Device device;
        std::uint64_t lost = 0;
        auto v = device.next();
        for (int k = 0; k < 40; ++k)
        {
            device.number += 2;
            v = device.next (3e-3, 3e-3);
            lost += v.lost;
        }
        CHECK (lost == 80);
        CHECK (v.fault == ReadingFault::lost);
    }
    SECTION ("by the rate, if there are no numbers")
    {
        StampWatch watch { 1000.0 };
        StampWatch::Assessment v;
        for (int k = 0; k < 40; ++k)
            v = watch ({ sizeof (tactus_device_stamp), 0, 0, 0.0, 0.0 }, 4e-3 * k);
        CHECK (v.fault == ReadingFault::lost);
    }
}

TEST_CASE ("readings that queue up on the way are as old as the clock of the device says", "[plugins][safety]")
{
    Device device;
    for (int k = 0; k < 100; ++k)
        device.next();
    double lag = 0.0;
    for (int k = 0; k < 100; ++k)
        lag = device.next (1.2e-3).lag_s;   // the program takes fewer than come
    CHECK (lag == Approx (0.02).epsilon (0.02));
}

TEST_CASE ("a time that is not a number makes the reading malformed, and a device that says nothing is taken at its word", "[plugins]")
{
    StampWatch watch { 0.0 };
    CHECK (watch ({ sizeof (tactus_device_stamp), 0, 1, std::nan (""), 0.0 }, 1.0).fault == ReadingFault::malformed);
    StampWatch plain { 0.0 };
    for (int k = 0; k < 10; ++k)
    {
        const auto v = plain ({ sizeof (tactus_device_stamp), 0, 0, 0.0, 0.0 }, k);
        CHECK (v.is_new);
        CHECK (v.fault == ReadingFault::none);
        CHECK (v.lag_s == 0.0);
    }
}
