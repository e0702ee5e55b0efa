// SPDX-License-Identifier: MIT
// What the driver of event devices makes of events and efforts, with a device in memory and times that are given.

#include "fake_events.hpp"
#include "support/corpus.hpp"
#include "support/rounds.hpp"

#include <fuzz/events_target.hpp>
#include <host/drivers/evdev/force_device.hpp>

#include <support/property.hpp>
#include <tactus/run/device/guard_limits.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>

using namespace tactus;
using namespace std::chrono_literals;
using host::evdev::ForceDevice;
using host::hid::PidCalibration;
using test::FakeEvents;

namespace
{
constexpr double turn = 5.0 * std::numbers::pi;   // 900 degrees
const PidCalibration torque { .full_force = 2.5, .turns = true, .travel = { { "x", turn } } };

/// A device that has been opened, with a time of its own.
struct Opened
{
    explicit Opened (FakeEvents::Info info, const PidCalibration& c = torque, double most_hz = 0.0) : on (events.add (std::move (info)))
    {
        auto opened = events.open (on.info.path);
        REQUIRE (opened);
        device = std::make_unique<ForceDevice> (std::move (*opened), c, most_hz);
        REQUIRE (device->prepare().empty());
        REQUIRE (device->rest() == 0);
        on.told.clear();
    }

    int write (double newtons, std::chrono::microseconds later)
    {
        now += later;
        tactus_effort effort {};
        effort.force[0] = effort.torque[1] = newtons;
        return device->write (effort, now);
    }

    int rumble (double strong, double weak, std::chrono::microseconds later, bool is_withheld = false)
    {
        now += later;
        tactus_effort effort = TACTUS_EFFORT;
        effort.is_withheld = is_withheld ? 1 : 0;
        effort.signals[0] = strong;
        effort.signals[1] = weak;
        return device->write (effort, now);
    }

    std::int32_t read (std::chrono::milliseconds timeout = 0ms)
    {
        reading = {};
        stamp = TACTUS_DEVICE_STAMP_INIT;
        return device->read (timeout, reading, stamp);
    }

    std::vector<int> levels() const
    {
        std::vector<int> all;
        for (const auto& t : on.told)
            if (t.what == "upload") all.push_back (t.level);
        return all;
    }
    auto count (const char* what) const { return std::ranges::count (on.told, what, &FakeEvents::Told::what); }

    FakeEvents events;
    FakeEvents::Device& on;
    std::unique_ptr<ForceDevice> device;
    ForceDevice::Clock::time_point now {};
    tactus_reading reading {};
    tactus_device_stamp stamp {};
};
}   // namespace

TEST_CASE ("a wheel at an event device is a rotation and a torque with limits, and its effect ends by itself", "[evdev]")
{
    FakeEvents events;
    auto& on = events.add (FakeEvents::wheel());
    auto opened = events.open (on.info.path);
    REQUIRE (opened);
    ForceDevice device { std::move (*opened), torque, 0.0 };
    REQUIRE (device.prepare().empty());

    // Full gain, no spring of its own, and an effect without a force that is not played.
    REQUIRE (on.told.size() == 3);
    CHECK (on.told[0].what == "upload");
    CHECK (on.told[0].level == 0);
    CHECK (on.told[0].length_ms == 500);
    CHECK (on.told[1].what == "gain");
    CHECK (on.told[1].level == 0xffff);
    CHECK (on.told[2].what == "autocenter");
    CHECK (on.told[2].level == 0);

    tactus_device_about about = TACTUS_DEVICE_ABOUT_INIT;
    device.describe (about);
    CHECK (about.tool == (TACTUS_DEVICE_ROTATION | TACTUS_DEVICE_TORQUE));
    REQUIRE (about.axis_count == 2);
    CHECK (std::string (about.axes[1]) == "z");
    REQUIRE (about.button_count == 2);
    CHECK (std::string (about.buttons[0]) == "trigger");
    CHECK (about.unrendered == (TACTUS_DEVICE_NO_FORCE_Y | TACTUS_DEVICE_NO_FORCE_Z | TACTUS_DEVICE_NO_TORQUE_X | TACTUS_DEVICE_NO_TORQUE_Z));
    CHECK (about.signal_outputs == 0);
    CHECK (about.device_watchdog_s == 0.5);
    CHECK (std::string (about.rest_file) == on.info.path);
    REQUIRE (about.rest_report_count == 1);
    input_event stop {};
    REQUIRE (about.rest_reports[0]->count == sizeof stop);
    std::memcpy (&stop, about.rest_reports[0]->bytes, sizeof stop);
    CHECK (stop.type == EV_FF);
    CHECK (stop.code == 0);   // the id of the effect
    CHECK (stop.value == 0);

    // The limits arrive as they are, and are those of the same wheel through HID.
    Messages messages;
    const auto limits = readGuardLimits (Json::parse (about.guard), "", messages);
    CHECK (messages.empty());
    CHECK (limits == device.limits());
    CHECK (limits.max_torque == 2.5);
    CHECK (limits.max_torque_slew == 625.0);
    CHECK (limits.max_angular_speed == 20.0);
    CHECK (limits.max_energy == 2.5);
    CHECK (limits.max_still == 5.0);   // a count is 0.24 mrad
    CHECK (limits.watchdog == 0.05);
}

TEST_CASE ("an event device describes itself to a Tactus whose structs are smaller", "[evdev]")
{
    Opened w { FakeEvents::wheel() };
    tactus_device_about about = TACTUS_DEVICE_ABOUT_INIT;
    about.size = offsetof (tactus_device_about, unrendered);
    w.device->describe (about);
    CHECK (about.device_watchdog_s == 0.5);
    CHECK (about.unrendered == 0u);
}

TEST_CASE ("a reading is what the whole reports of an event device have left", "[evdev]")
{
    Opened w { FakeEvents::wheel() };
    CHECK (w.read() == TACTUS_DEVICE_NONE);   // the state of before it was opened does not count
    w.events.send (w.on, { { EV_ABS, ABS_X, 65535, 0.0 }, { EV_KEY, BTN_THUMB, 1, 0.0 } });
    CHECK (w.read() == TACTUS_DEVICE_NONE);   // a report that is not whole
    w.events.send (w.on, { { EV_SYN, SYN_REPORT, 0, 0.0 } });
    REQUIRE (w.read() == TACTUS_DEVICE_OK);
    CHECK (w.reading.rotation[1] == Approx (0.5 * turn));
    CHECK (w.reading.axis_count == 2);
    CHECK (w.reading.axes[0] == Approx (0.5 * turn));
    CHECK (w.reading.axes[1] == Approx (1.0));   // not calibrated
    CHECK (w.reading.buttons == 2u);
    CHECK (w.reading.valid == 1);

    // While nothing changes, it is the same, and new; a report that was late has its age.
    REQUIRE (w.read() == TACTUS_DEVICE_OK);
    CHECK (w.reading.rotation[1] == Approx (0.5 * turn));
    CHECK (w.reading.age_s == 0.0);
    w.events.send (w.on, { { EV_ABS, ABS_X, 0, 0.03 }, { EV_KEY, BTN_THUMB, 0, 0.03 }, { EV_SYN, SYN_REPORT, 0, 0.03 } });
    REQUIRE (w.read() == TACTUS_DEVICE_OK);
    CHECK (w.reading.rotation[1] == Approx (-0.5 * turn));
    CHECK (w.reading.age_s == 0.03);
    CHECK (w.reading.buttons == 0u);

    // Reports that wait come one by one.
    for (const int x : { 1, 2, 3 })
        w.events.move (w.on, x);
    for (const int x : { 1, 2, 3 })
    {
        REQUIRE (w.read() == TACTUS_DEVICE_OK);
        CHECK (w.reading.rotation[1] == Approx (turn * (x / 65535.0 - 0.5)));
    }
    w.events.change (w.on, false);
    CHECK (w.read() == TACTUS_DEVICE_GONE);
    CHECK (w.write (1.0, 4ms) == ENODEV);
}

TEST_CASE ("a stick at an event device is a position and a force, with y and z as Tactus has them", "[evdev]")
{
    auto info = FakeEvents::wheel();
    info.axes.push_back ({ .code = ABS_Y, .name = "y", .minimum = -100, .maximum = 100, .value = 0 });
    Opened s { info, { .full_force = 4.0, .travel = { { "x", 0.12 }, { "y", 0.1 } } } };
    s.events.send (s.on, { { EV_ABS, ABS_X, 65535, 0.0 }, { EV_ABS, ABS_Y, 100, 0.0 }, { EV_ABS, ABS_Z, 0, 0.0 }, { EV_SYN, SYN_REPORT, 0, 0.0 } });
    REQUIRE (s.read() == TACTUS_DEVICE_OK);
    CHECK (s.reading.position[0] == Approx (0.06));
    CHECK (s.reading.position[1] == Approx (-0.05));
    CHECK (s.reading.position[2] == 0.0);   // its travel is unknown
    CHECK (s.reading.axes[1] == Approx (-1.0));
    CHECK (s.device->limits().max_force == 4.0);
    CHECK (s.write (1.0, 4ms) == 0);
    CHECK (s.levels().back() == -static_cast<int> (std::lround (1.0 / 4.0 * 32767.0)));   // a positive level pushes to the left
}

TEST_CASE ("a force at an event device is its level, rounded, and never beyond what may be used", "[evdev]")
{
    rc::check ("levels", [] {
        const auto full = *rc::gen::inRange (1, 1000) * 0.01;
        const auto usable = *rc::gen::element (1.0, 0.1);
        const bool is_reversed = *rc::gen::arbitrary<bool>();
        Opened s { FakeEvents::wheel(), { .full_force = full, .is_reversed = is_reversed, .usable = usable, .travel = { { "x", 0.1 } } } };
        for (int i = 0; i < 20; ++i)
        {
            const double force = *rc::gen::inRange (-2000, 2000) * 1e-3 * full;
            RC_ASSERT (s.write (force, 10ms) == 0);
            const double used = std::clamp (force / full, -usable, usable);
            const auto level = static_cast<int> (std::floor (std::abs (used) * 32767.0 + 0.5)) * (used < 0.0 ? -1 : 1) * (is_reversed ? 1 : -1);
            RC_ASSERT ((s.levels().empty() ? 0 : s.levels().back()) == level);
        }
    });
}

TEST_CASE ("the measured rate of an event device is a mean of many updates", "[evdev]")
{
    auto info = FakeEvents::wheel();
    info.update_interval_s = 10e-3;
    Opened w { info };
    int at = 0;
    const auto shown = [&] {
        w.events.move (w.on, ++at);
        REQUIRE (w.read() == TACTUS_DEVICE_OK);
        return w.stamp.reached_hz;
    };
    REQUIRE (w.write (0.5, 10ms) == 0);
    REQUIRE (w.write (0.0, 1ms) == 0);   // a zero waits for nothing
    CHECK (shown() == 0.0);              // one interval of 1 ms is not 1000 Hz
    for (int i = 1; i <= 20; ++i)
        REQUIRE (w.write (0.01 * i, 20ms) == 0);
    CHECK (shown() > 45.0);
    CHECK (shown() < 60.0);
}

TEST_CASE ("updates of a force come no faster than the port takes them, the newest counts, and the end waits for nothing", "[evdev]")
{
    auto info = FakeEvents::wheel();
    info.update_interval_s = 4e-3;
    Opened w { info };
    for (int i = 1; i <= 1000; ++i)   // one second of ticks
        REQUIRE (w.write (1e-3 * i, 1ms) == 0);
    const auto levels = w.levels();
    const auto starts = w.count ("play");
    CHECK (starts >= 4);   // every 0.2 s, because the effect lasts for half a second
    CHECK (starts <= 6);
    CHECK (static_cast<std::ptrdiff_t> (levels.size()) + starts <= 251);   // each is a report
    CHECK (levels.size() >= 240);
    for (std::size_t i = 1; i < levels.size(); ++i)
    {
        const double newtons = -levels[i] * 2.5 / 32767.0;   // that of some tick, in order
        CHECK (std::abs (newtons - 1e-3 * std::round (newtons / 1e-3)) < 1e-4);
        CHECK (levels[i] < levels[i - 1]);
    }
    w.events.move (w.on, 1);
    REQUIRE (w.read() == TACTUS_DEVICE_OK);
    CHECK (w.stamp.reached_hz > 235.0);   // measured
    CHECK (w.stamp.reached_hz < 251.0);

    const auto before = w.on.told.size();
    REQUIRE (w.write (0.9, 0us) == 0);
    CHECK (w.on.told.size() == before);   // left out
    REQUIRE (w.write (0.0, 0us) == 0);
    REQUIRE (w.on.told.size() == before + 1);
    CHECK (w.levels().back() == 0);
    REQUIRE (w.write (0.0, 300ms) == 0);
    CHECK (w.on.told.size() == before + 1);   // nothing new

    // It ends at once, and starts again afterwards.
    REQUIRE (w.write (1.0, 4ms) == 0);
    w.on.told.clear();
    REQUIRE (w.device->rest() == 0);
    REQUIRE (w.on.told.size() == 2);
    CHECK (w.on.told[0].what == "stop");
    CHECK (w.levels().back() == 0);
    w.on.told.clear();
    REQUIRE (w.write (1.0, 0us) == 0);
    REQUIRE (w.on.told.size() == 2);
    CHECK (w.on.told[0].what == "upload");
    CHECK (w.on.told[1].what == "play");
}

TEST_CASE ("the rate of updates is the person's where the port does not say it, and never faster than the port", "[evdev]")
{
    auto info = FakeEvents::wheel();
    CHECK (Opened (info).device->interval().count() == Approx (4e-3));
    CHECK (Opened (info, torque, 1000.0).device->interval().count() == Approx (1e-3));
    info.update_interval_s = 8e-3;
    CHECK (Opened (info).device->interval().count() == Approx (8e-3));
    CHECK (Opened (info, torque, 1000.0).device->interval().count() == Approx (8e-3));
    CHECK (Opened (info, torque, 50.0).device->interval().count() == Approx (20e-3));
}

TEST_CASE ("an update that fails is told again with the next force", "[evdev][safety]")
{
    Opened w { FakeEvents::wheel() };
    w.on.upload_fails = EBUSY;
    CHECK (w.write (1.0, 4ms) == EBUSY);
    CHECK (w.device->rest() == EBUSY);
    w.on.upload_fails = 0;
    CHECK (w.write (1.0, 4ms) == 0);
    CHECK (w.levels().back() == -static_cast<int> (std::lround (1.0 / 2.5 * 32767.0)));
    CHECK (w.on.told.back().what == "play");
}

TEST_CASE ("the motors of a pad get the amplitude of their signals, and rest when these do", "[evdev]")
{
    Opened p { FakeEvents::pad(), {} };
    CHECK (p.device->limits().max_signal == 1.0);
    CHECK (p.device->limits().max_force == GuardLimits::none);
    const auto tone = [&] (double strong, double weak, int ms) {
        for (int i = 0; i < ms; ++i)
        {
            const double wave = std::sin (2.0 * std::numbers::pi * 0.16 * i);   // at 160 Hz
            REQUIRE (p.rumble (strong * wave, weak * wave, 1ms) == 0);
        }
    };
    tone (0.5, 0.25, 1000);
    REQUIRE_FALSE (p.on.told.empty());
    const auto uploads = p.count ("upload");
    CHECK (uploads <= 100);   // at most one in 10 ms
    const auto latest = *std::ranges::find_if (p.on.told.rbegin(), p.on.told.rend(), [] (const auto& t) { return t.what == "upload"; });
    CHECK (latest.level > 0.48 * 65535.0);
    CHECK (latest.level <= 0.5 * 65535.0 + 1.0);
    CHECK (latest.weak == Approx (0.5 * latest.level).margin (2.0));
    CHECK (p.count ("play") >= 4);

    // A stop ends with its fade, without the time for which the amplitude holds peaks.
    const auto amplitude = [&] { return p.on.told.back().what == "upload" ? p.on.told.back().level + p.on.told.back().weak : -1; };
    REQUIRE (p.rumble (0.2, 0.0, 1ms, true) == 0);
    REQUIRE (p.rumble (0.0, 0.0, 1ms, true) == 0);
    CHECK (amplitude() == 0);

    // Without a stop, it holds them.
    tone (0.5, 0.25, 100);
    tone (0.0, 0.0, 7);
    CHECK (amplitude() != 0);
    tone (0.0, 0.0, 30);
    CHECK (amplitude() == 0);
    tone (3.0, 0.0, 100);
    CHECK (std::ranges::max (p.on.told, {}, &FakeEvents::Told::level).level == 65535);
}

TEST_CASE ("a device with a constant force is not rumbled: one motor would render both", "[evdev][safety]")
{
    auto info = FakeEvents::wheel();
    info.has_rumble = true;
    Opened w { info };
    tactus_device_about about = TACTUS_DEVICE_ABOUT_INIT;
    w.device->describe (about);
    CHECK (about.signal_outputs == 0);
    REQUIRE (w.rumble (1.0, 1.0, 4ms) == 0);
    CHECK (w.on.told.empty());
}

TEST_CASE ("every file of the events corpus leaves finite readings and a device at rest", "[evdev][safety]")
{
    CHECK (test::replay ("events", fuzz::tryEvents) > 20);
}

TEST_CASE ("a long run of a wheel at an event device: each change is read once and in order, each torque reaches it, and none after a stop", "[evdev][soak]")
{
    // TACTUS_SOAK_SECONDS of the device's time, in which it sends 1000 changes and gets 1000 torques a second. The time is given, so this shows that nothing
    // is lost, doubled or out of order, and that the effect is restarted before it ends. Threads and the kernel are those of evdev_driver_test and the guest.
    const auto* wanted = std::getenv ("TACTUS_SOAK_SECONDS");
    const auto ticks = wanted != nullptr ? static_cast<std::uint64_t> (1000.0 * std::max (1.0, std::atof (wanted))) : test::rounds (60'000ull);
    Opened wheel { FakeEvents::wheel(), torque, 1000.0 };
    std::uint64_t read = 0, uploaded = 0, started = 0, wrong = 0, started_at = 0, longest_ms = 0;
    for (std::uint64_t k = 0; k < ticks; ++k)
    {
        const int place = static_cast<int> (k % 60'000) + 1000;
        wheel.events.move (wheel.on, place);
        read += wheel.read() == TACTUS_DEVICE_OK ? 1 : 0;
        wrong += std::abs (wheel.reading.rotation[1] - (place / 65535.0 - 0.5) * turn) > 1e-3 ? 1 : 0;
        const double newton_metres = 0.01 * (static_cast<double> (k % 200) - 100.5);
        wrong += wheel.write (newton_metres, 1ms) != 0 ? 1 : 0;
        for (const auto& told : wheel.on.told)
        {
            if (told.what == "upload")
            {
                ++uploaded;
                wrong += told.level != -static_cast<int> (std::lround (newton_metres / 2.5 * 32767.0)) ? 1 : 0;
            }
            if (told.what != "play") continue;
            ++started;
            started_at = k;
        }
        longest_ms = std::max (longest_ms, k - started_at);
        wheel.on.told.clear();
    }
    CHECK (read == ticks);
    CHECK (uploaded + started == ticks);   // a start is a report, too, and takes the time of one torque
    CHECK (wrong == 0);
    CHECK (longest_ms < 500);   // how long the effect lasts
    wheel.write (0.0, 1ms);
    CHECK (wheel.levels() == std::vector<int> { 0 });
    if (wanted != nullptr) std::cout << "event device: " << read << " changes, " << uploaded << " torques in their order\n";
}
