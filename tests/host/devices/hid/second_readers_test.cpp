// SPDX-License-Identifier: MIT
// The judge and the limiters of plugins and of sound against those of reports and of the guard, over random input (docs/decisions/second_readers.md).

#include "hid.hpp"

#include <support/property.hpp>

#include <host/devices/audio/channel_limit.hpp>
#include <host/devices/device_plugins/effort_limiter.hpp>
#include <host/devices/device_plugins/stamp_watch.hpp>
#include <host/devices/hid/reading_judge.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
double within (double least, double most) { return least + (most - least) * *rc::gen::inRange (0, 100'001) / 100'000.0; }
Vec3 anyVector (double size) { return { within (-size, size), within (-size, size), within (-size, size) }; }

/// A report of the Tactus board that is at 0, homed and driven.
std::array<std::uint8_t, 64> reportOf (std::uint32_t number, std::uint32_t us)
{
    std::array<std::uint8_t, 64> report { 0x54, 1, 0b11 };
    for (std::size_t i = 0; i < 4; ++i)
    {
        report[4 + i] = static_cast<std::uint8_t> (number >> (8 * i));
        report[8 + i] = static_cast<std::uint8_t> (us >> (8 * i));
    }
    return report;
}
}   // namespace

TEST_CASE ("the judge of a plugin's readings says what the judge of reports says", "[hid][plugins][property]")
{
    test::property ("any order of readings", [] {
        HidModel model (test::profileOf ("tactus_board"));
        ReadingJudge reports (model);
        host::StampWatch stamps (1000.0);
        std::uint32_t number = 1000, us = 1'000'000;
        for (int k = 0; k < 200; ++k)
        {
            // The next one, the last one again, a few lost, or an earlier one. The clock of the device agrees with its number.
            const int what = *rc::gen::inRange (0, 20);
            const int by = what == 0 ? 0 : what == 1 ? *rc::gen::inRange (2, 40)
                                       : what == 2   ? -*rc::gen::inRange (1, 5)
                                                     : 1;
            number += static_cast<std::uint32_t> (by);
            us += static_cast<std::uint32_t> (1000 * by);
            const Nanoseconds now = 1'000'000 * (k + 1);
            reports.begin();
            reports.take (reportOf (number, us), now);
            const auto first = reports.reading ({ .now = now + 1 });
            const auto second = stamps ({ sizeof (tactus_device_stamp), 0, number, 1e-6 * us, 0.0 }, 1e-9 * static_cast<double> (now));
            RC_ASSERT ((first.age == 0.0) == second.is_new);
            if (second.is_new) RC_ASSERT (first.fault == second.fault);
        }
    });
}

TEST_CASE ("the limiter of a plugin's efforts changes a force as the limiter of motors does", "[hid][plugins][property]")
{
    test::property ("any forces and times", [] {
        HidModel motors (test::profileOf ("tactus_board"));
        motors.decode (reportOf (1, 1));   // without a pose, no motor gets a force
        host::EffortLimiter efforts { GuardLimits { .max_slew = motors.limits().max_slew } };
        for (int k = 0; k < 50; ++k)
        {
            const Effort wanted { .force = anyVector (2.0) };
            const double passed = *rc::gen::element (0.0, 1e-4, 1e-3, 0.02);
            const auto driven = motors.drive ({ wanted.force, Vec3::Zero(), motors.restEfforts() }, passed);
            const auto& allowed = efforts (wanted, passed).force;
            for (int i = 0; i < 3; ++i)
            {
                const auto& names = motors.effortNames();
                const auto at = std::ranges::find (names, motors.profile().force[static_cast<std::size_t> (i)]) - names.begin();
                RC_ASSERT (std::abs (driven[static_cast<std::size_t> (at)] - allowed[i]) < 1e-9);
            }
        }
    });
}

TEST_CASE ("the limit of a channel of sound is that of the guard of a signal", "[hid][audio][property]")
{
    test::property ("any samples and limits", [] {
        constexpr double period = 1e-3;
        const double most = within (0.01, 0.9), slew = within (1.0, 500.0);
        Guard guard;
        guard.prepare ({ .max_signal = most, .max_signal_slew = slew }, period);
        host::audio::ChannelLimit channel;
        channel.tighten (most, slew);
        Reading reading;
        reading.valid = true;
        for (int k = 0; k < 50; ++k)
        {
            auto sample = static_cast<float> (within (-1.0, 1.0));
            Effort wanted;
            wanted.signals.set (0, static_cast<double> (sample));
            const double guarded = guard (wanted, reading).signals[0];
            channel (&sample, 1, period);
            RC_ASSERT (std::abs (guarded - static_cast<double> (sample)) < 1e-6);
        }
    });
}
