// SPDX-License-Identifier: MIT
// The driver of 3D Systems' arms, with its helper process, against a fake of OpenHaptics. Both are ours; no arm has been tried.

#include "../dry_wood.hpp"
#include "../trial_person.hpp"
#include "support/sketch.hpp"
#include "touch_lab.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <thread>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::TouchLab;

namespace
{
bool contains (const std::string& text, const char* part) { return text.find (part) != std::string::npos; }
}   // namespace

TEST_CASE ("a Touch is read and pushed in the axes of Tactus", "[openhaptics]")
{
    TouchLab lab;
    REQUIRE (lab.opens());
    CHECK (lab.limits.max_force == 3.3);
    CHECK (lab.limits.max_torque == GuardLimits::none);
    CHECK (lab.device_watchdog_s == Approx (0.022));
    CHECK (contains (lab.device->about().about, "Touch, serial number SN1, library 3.4."));
    lab.arm().target[0] = 20.0;   // right
    lab.arm().target[1] = 10.0;   // up
    lab.arm().target[2] = 30.0;   // towards the person
    const auto is_at = [&] (const Vec3& place) { return (lab.reading.position - place).norm() < 5e-5; };
    const Vec3 middle { 0.02, -0.03, 0.01 };
    REQUIRE (lab.ticksUntil ([&] { return lab.reading.valid && is_at (middle); }));
    const int axis = GENERATE (0, 1, 2);
    Vec3 pushed = middle;
    pushed[axis] += 1.0 / 500.0;
    CHECK (lab.ticksUntil ([&] { return is_at (pushed); }, TouchLab::along (axis)));
    lab.arm().buttons = 2;
    CHECK (lab.ticksUntil ([&] { return lab.reading.buttons == 2; }));

    // It ends with zeros, and without a call that the library does not expect.
    lab.device.reset();
    CHECK (lab.arm().force[1] == 0.0);
    CHECK (lab.arm().is_open == 0);
    CHECK (lab.arms->stops == 1);
    CHECK (lab.arms->frame_errors == 0);
    CHECK (lab.arms->gets_outside_frames == 0);
    CHECK (lab.arms->calls_after_unschedule == 0);
    CHECK (lab.arm().updates_in_frame == 0);
}

TEST_CASE ("the stylus of a Premium turns and is turned in the axes of Tactus", "[openhaptics]")
{
    TouchLab lab;
    auto& arm = lab.arm();
    arm.output_dof = 6;
    arm.max_force = 8.5;
    // Turned by 2 rad about (1, 2, 2)/3 of the library, with the small errors of its matrix. By columns.
    const Vec3 axis { 1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0 };
    const double angle = 2.0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
        {
            const int third = 3 - row - column;
            const double cross = row == column ? 0.0 : ((column - row + 3) % 3 == 1 ? -1.0 : 1.0) * axis[third];
            const double exact = (row == column ? std::cos (angle) : 0.0) + (1.0 - std::cos (angle)) * axis[row] * axis[column] + std::sin (angle) * cross;
            arm.transform[static_cast<std::size_t> (4 * column + row)] = exact * (1.0 + 1e-7);
        }
    REQUIRE (lab.opens());
    CHECK (lab.limits.max_torque == 0.188);
    CHECK (lab.limits.max_force == 8.5);
    REQUIRE (lab.ticksUntil ([&] { return lab.reading.valid; }));
    CHECK ((lab.reading.rotation - angle * Vec3 (axis.x(), -axis.z(), axis.y())).norm() < 1e-6);
    Effort effort;
    effort.torque = { 0.05, 0.02, -0.1 };
    CHECK (lab.ticksUntil (
        [&] { return arm.torque[0] == Approx (50.0) && arm.torque[1] == Approx (-100.0) && arm.torque[2] == Approx (-20.0); },   // mN m
        effort));
}

TEST_CASE ("dry wood on a Touch has the forces of its render at the positions that the arm has rounded", "[openhaptics]")
{
    TouchLab lab;
    auto& arm = lab.arm();
    arm.is_stepped = 1;
    arm.step = 1;
    test::DryWood wood { host::openhaptics::driver, Json::object() };
    const auto servoTicks = [&] {   // once, and ends its frame
        const auto frames = arm.frames.load();
        ++arm.step;
        return eventually (20us, 1'000'000, [&] { return arm.frames > frames; });
    };
    const int readings = test::readings (30'000);
    std::uint64_t more = 0;
    for (int k = 0; k < readings; ++k)
    {
        const Vec3 at = test::DryWood::placeAt (k);
        const double by_library[] { 1e3 * at.x(), 1e3 * at.z(), -1e3 * at.y() };
        for (std::size_t i = 0; i < 3; ++i)
            arm.target[i] = by_library[i];
        const auto rounded = [&] (std::size_t i) { return 1e-3 * (std::round (by_library[i] / 1e-3) * 1e-3); };   // by hand, as the arm does
        const auto frames = arm.frames.load();
        ++arm.step;   // its frame waits for the force
        const Vec3 asked = wood.tick ({ rounded (0), -rounded (2), rounded (1) }, [&] (const auto&, const auto& stamp) { return stamp.number > frames; });
        INFO ("reading " << k << " asks for " << asked.transpose());
        REQUIRE (eventually (20us, 1'000'000, [&] { return arm.frames > frames; }));
        const auto has_come = [&] { return Vec3 (arm.force[0], -arm.force[2], arm.force[1]) == asked; };
        for (int tries = 0; ! has_come() && tries < 1000; ++tries, ++more)   // a busy computer has missed the tick, or its force comes back by and by
        {
            wood.writeAgain();
            REQUIRE (servoTicks());
        }
        REQUIRE (has_come());
    }
    CHECK (wood.pushes() > readings / 4);
    CHECK_FALSE (wood.hasFailed());
    std::cout << "dry wood on a Touch: " << more << " servo ticks more than " << readings << " readings\n";
}

TEST_CASE ("a Touch is found by name, or by the names that makers have given, or its absence is explained", "[openhaptics]")
{
    SECTION ("a second arm")
    {
        TouchLab lab;
        lab.arms->count = 2;
        REQUIRE (lab.opens ("Second"));
        CHECK (lab.arm (1).is_open == 1);
        CHECK (lab.arm (0).is_open == 0);
        CHECK (contains (lab.device->about().about, "SN2"));
    }
    SECTION ("versions that do not know one without a name")
    {
        TouchLab lab;
        lab.arms->refuses_null = 1;
        CHECK (lab.opens());
        lab.device.reset();
        lab.arms->only_old_name = 1;
        CHECK (lab.opens());
    }
    SECTION ("none")
    {
        TouchLab lab;
        lab.arm().is_missing = 1;
        std::filesystem::create_directories (lab.folder / ".3dsystems/config");
        lab.folder.write (".3dsystems/config/Left arm.config", "");
        const auto said = lab.said();
        CHECK (contains (said, "no arm can be opened (names that its setup has stored: Left arm): the arm without a name: device fault (error 0x300, "
                               "-3 inside the library); Default Device: "));
        CHECK (contains (lab.said ("Right arm"), "Right arm: device fault"));
    }
    SECTION ("no library")
    {
        TouchLab lab { nullptr };
        CHECK (contains (lab.said(), "libHD.so: cannot open shared object file: No such file or directory"));
    }
    SECTION ("a library that needs another one")
    {
        TouchLab lab { "needy_hd" };
        CHECK (contains (lab.said(), "libneeded_by_fake.so: cannot open shared object file: No such file or directory"));
    }
    SECTION ("a servo loop that does not start")
    {
        TouchLab lab;
        lab.arms->does_not_start = 1;
        CHECK (contains (lab.said(), "the library does not start: an error (error 0x304"));
    }
    SECTION ("an arm without a largest force is only read")
    {
        TouchLab lab;
        lab.arm().max_force = -1.0;
        CHECK (contains (lab.said(), "the arm has no force: its library does not tell the largest force"));
        CHECK (lab.ticksUntil ([&] { return lab.reading.valid; }));
    }
    SECTION ("a library that tells numbers only within a frame, in a locale that is not C")
    {
        TouchLab lab;
        lab.arms->needs_frame = 1;
        ::setenv ("LC_ALL", "de_DE.UTF-8", 1);
        CHECK (lab.said().empty());
        ::unsetenv ("LC_ALL");
        CHECK (lab.limits.max_force == 3.3);
        CHECK (contains (lab.device->about().about, "Its library reads numbers as in C, not as in de_DE.UTF-8."));
        CHECK (lab.pushes());
        CHECK (lab.arms->gets_outside_frames == 0);
    }
    SECTION ("an arm that only knows its own rate")
    {
        TouchLab lab;
        lab.arms->refuses_rate = 1;
        lab.arms->rate = 500;
        CHECK (lab.said().empty());
        CHECK (lab.device->about().rate_hz == 500.0);
        CHECK (lab.pushes());
    }
}

TEST_CASE ("the driver of 3D Systems' arms lists the names that their setup has stored, and opens none", "[openhaptics]")
{
    const auto find = [] {
        const auto driver = host::DeviceDriver::within (host::openhaptics::driver);
        REQUIRE (driver);
        return (*driver)->find();
    };
    TouchLab lab;
    const auto nameless = find();
    REQUIRE (nameless);
    REQUIRE (nameless->size() == 1);
    CHECK ((*nameless)[0].description == Json { { "driver", "openhaptics" } });
    CHECK_FALSE ((*nameless)[0].is_seen);
    std::filesystem::create_directories (lab.folder / ".3dsystems/config");
    for (const auto* name : { "Right", "Left arm" })
        lab.folder.write (".3dsystems/config/" + std::string (name) + ".config", "");
    lab.folder.write (".3dsystems/config/notes.txt", "");
    const auto all = find();
    REQUIRE (all);
    REQUIRE (all->size() == 2);
    CHECK ((*all)[0].description == Json { { "driver", "openhaptics" }, { "port", "Left arm" } });
    CHECK ((*all)[1].description["port"] == Json ("Right"));
    CHECK_FALSE ((*all)[0].is_seen);
    CHECK (lab.arms->process == 0);

    // Without the library, there is nothing to play on, whatever names are stored.
    const TouchLab needy ("needy_hd");
    const auto none = find();
    REQUIRE_FALSE (none);
    CHECK (contains (none.error().text, "needed_by_fake.so: cannot open shared object file"));
    CHECK (contains (none.error().text, "libHD.so.3.0: cannot open shared object file: No such file or directory"));   // to the end
}

TEST_CASE ("a Touch that does not know its position has no force until it does", "[openhaptics][safety]")
{
    TouchLab lab;
    auto& arm = lab.arm();
    SECTION ("a person has to put the stylus into the inkwell")
    {
        arm.styles = 4;
        arm.calibration = 2;
        CHECK (contains (lab.said(), "put its stylus into the inkwell"));
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_homed; }, TouchLab::along (2)));
        CHECK (arm.force[1] == 0.0);
        arm.calibration = 1;   // the stylus is there
        CHECK (lab.pushes());
        CHECK (arm.updates == 1);
    }
    SECTION ("it calibrates itself")
    {
        arm.calibration = 1;
        REQUIRE (lab.opens());
        CHECK (lab.pushes());
    }
    SECTION ("its encoders are reset before the servo loop starts")
    {
        arm.styles = 1;
        REQUIRE (lab.opens());
        CHECK (arm.updates == 1);
        CHECK (lab.pushes());
        arm.calibration = 1;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_homed; }));
        CHECK (arm.updates == 1);   // while the servo loop runs, encoders are not reset
    }
    CHECK (arm.updates_in_frame == 0);
}

TEST_CASE ("errors of a Touch stop it for half a second, or end it, and are named", "[openhaptics][safety]")
{
    TouchLab lab;
    auto& arm = lab.arm();
    const auto options = host::PluginDevice::Options { .silence_s = 60.0, .look_again = 1h, .patience = 1min, .real_time = false };
    REQUIRE (lab.opens ({}, options));
    REQUIRE (lab.pushes());
    SECTION ("warm motors")
    {
        arm.lasting_error = 0x200;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::too_hot && arm.force[1] == 0.0; }, TouchLab::along (2)));
        arm.lasting_error = 0;
        CHECK (lab.pushes());
    }
    SECTION ("too fast, or too much force")
    {
        arm.next_error = GENERATE (0x201, 0x202, 0x203, 0x204);
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_driven && arm.force[1] == 0.0; }, TouchLab::along (2)));
        CHECK (lab.pushes());
        CHECK (lab.device->counts().departures == 0);
    }
    SECTION ("unplugged")
    {
        arm.is_unplugged = 1;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::unplugged; }));
        CHECK (contains (lab.device->trouble(), "communication error (error 0x302, -28 inside the library)"));
    }
}

TEST_CASE ("a Touch keeps a force for at most 20 ms after the last message", "[openhaptics][safety]")
{
    TouchLab lab;
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    // No tick comes.
    CHECK (eventually ([&] { return lab.arm().force[1] == 0.0; }));
    CHECK (lab.device->counts().silences == 0);   // it was the helper
    CHECK (lab.pushes());
}

TEST_CASE ("a library that stalls or dies costs a stop, and its death is told", "[openhaptics][safety]")
{
    TouchLab lab;
    const auto options = host::PluginDevice::Options { .silence_s = 60.0, .look_again = 1h, .patience = 1min, .real_time = false };
    REQUIRE (lab.opens ({}, options));
    REQUIRE (lab.pushes());
    const auto process = lab.arms->process.load();
    SECTION ("for 30 ms")
    {
        lab.arms->stall_ms = 30;
        CHECK (lab.ticksUntil ([&] { return lab.arms->stall_ms == 0 && lab.device->counts().oldest > 0.02; }));
        CHECK (lab.pushes());
        CHECK (lab.device->counts().departures == 0);
    }
    SECTION ("for 2 s, or for ever")
    {
        lab.arms->stall_ms = GENERATE (2000, -1);
        CHECK (lab.ticksUntil ([&] { return lab.reading.age > 0.02; }, TouchLab::along (2)));
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::unplugged; }, TouchLab::along (2)));
        CHECK (contains (lab.device->trouble(), "its library has not moved for a second, so its process was killed. The arm may still push"));
    }
    SECTION ("killed")
    {
        ::kill (process, SIGKILL);
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::unplugged; }, TouchLab::along (2)));
        CHECK (contains (lab.device->trouble(), "the process that owns its library has died. The arm may still push: switch it off"));
        CHECK (lab.arm().disables == 0);
    }
    SECTION ("frozen")
    {
        ::kill (process, SIGSTOP);
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::unplugged; }, TouchLab::along (2)));
        CHECK (contains (lab.device->trouble(), "so its process was killed"));
    }
    SECTION ("a library that does not stop")
    {
        lab.arms->stop_hangs = 1;
        lab.device.reset();
        CHECK (lab.arm().force[1] == 0.0);   // before it hangs
        CHECK (::kill (process, 0) != 0);
    }
}

TEST_CASE ("each reading of a Touch says when it was taken, so a hand that moves on while the servo loop stalls does not seem to jump", "[openhaptics][safety]")
{
    const TouchLab lab;
    const auto driver = host::DeviceDriver::within (host::openhaptics::driver);
    REQUIRE (driver);
    Messages messages;
    const auto opened = (*driver)->open (Json { { "driver", "openhaptics" } }, messages);
    REQUIRE (opened);
    CHECK ((opened->about().stamps & TACTUS_DEVICE_TIMES) != 0);
    host::DriverReport why;
    const auto next = [&] {
        tactus_reading reading {};
        tactus_device_stamp stamp {};
        REQUIRE (eventually (0ns, [&] { return opened->read (50ms, reading, stamp, why) == TACTUS_DEVICE_OK; }));
        return stamp;
    };
    auto before = next();
    lab.arms->stall_ms = 18;
    double longest = 0.0;
    for (int left = 20; left > 0; left -= lab.arms->stall_ms == 0 ? 1 : 0)   // the ticks before the stall, and some after it
    {
        const auto stamp = next();
        CHECK (stamp.time_s > before.time_s);
        if (stamp.number == before.number + 1) longest = std::max (longest, stamp.time_s - before.time_s);
        before = stamp;
    }
    CHECK (longest >= 0.018);
}

TEST_CASE ("a Touch whose process was killed is opened again, with a force from zero", "[openhaptics][safety]")
{
    TouchLab lab;
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    const auto process = lab.arms->process.load();
    lab.arm().is_open = 0;   // the system closes it
    ::kill (process, SIGKILL);
    lab.arm().force[1] = 0.0;
    CHECK (lab.ticksUntil ([&] { return lab.arms->process != process && lab.reading.valid; }));
    CHECK (lab.pushes());
    CHECK (lab.device->counts().departures == 1);
}

TEST_CASE ("two arms of 3D Systems share the servo loop of their library, and one that is not ticked may join and leave", "[openhaptics][safety]")
{
    TouchLab lab;
    lab.arms->count = 2;
    REQUIRE (lab.opens ("Default Device"));
    const auto process = lab.arms->process.load();
    const auto driver = host::DeviceDriver::within (host::openhaptics::driver);
    REQUIRE (driver);
    const auto second = [&] (Messages& messages) {
        auto there = (*driver)->open ({ { "driver", "openhaptics" }, { "port", "Second" } }, messages);
        return there ? std::make_unique<host::PluginDevice> (std::move (there), std::nullopt, TouchLab::patient()) : nullptr;
    };
    Messages messages;
    auto other = second (messages);
    INFO (tactus::test::text (messages));
    REQUIRE (other != nullptr);
    other->prepare (1e-3);
    CHECK (lab.arms->process == process);
    CHECK (lab.arms->starts == 2);   // once more for the second arm

    // Each gets its own force.
    const auto bothPush = [&] {
        return eventually ([&] {
            lab.tick (TouchLab::along (2));
            const auto reading = other->read();
            other->write (reading.valid ? TouchLab::along (0, 0.5) : Effort {});
            return lab.arm (0).force[1] == 1.0 && lab.arm (1).force[0] == 0.5;
        });
    };
    CHECK (bothPush());

    // An error belongs to the arm that it names, whichever frame it comes in.
    lab.arm (1).error_elsewhere = 0x200;
    ReadingFault seen = ReadingFault::none;
    CHECK (eventually ([&] {
        lab.tick (TouchLab::along (2));
        seen = other->read().fault;
        return seen != ReadingFault::none;
    }));
    CHECK (seen == ReadingFault::too_hot);
    CHECK (lab.reading.fault == ReadingFault::none);
    CHECK (bothPush());

    // While a run ticks one of them, the other one can neither leave the library nor join it again. It has no force.
    other.reset();
    CHECK (lab.arm (1).force[0] == 0.0);
    std::atomic<bool> ends = false;
    std::thread run ([&] {
        while (! ends)
        {
            lab.tick (TouchLab::along (2));
            std::this_thread::yield();
        }
    });
    bool was_refused = false;   // a computer that is so busy that no tick comes for 50 ms lets it join
    for (int tries = 0; tries < 1000 && ! was_refused; ++tries)
    {
        messages.clear();
        was_refused = second (messages) == nullptr;
    }
    ends = true;
    run.join();
    CHECK (was_refused);
    CHECK (contains (tactus::test::text (messages), "another arm of this program is in use"));
    CHECK (lab.device->counts().departures == 0);

    // Once no run ticks, it can.
    messages.clear();
    REQUIRE (eventually ([&] { return lab.arm (1).is_open == 0; }));
    other = second (messages);
    INFO (tactus::test::text (messages));
    REQUIRE (other != nullptr);
    other->prepare (1e-3);
    CHECK (bothPush());

    // Both are lost with the process, and come back.
    lab.arm (0).is_open = lab.arm (1).is_open = 0;
    ::kill (process, SIGKILL);
    CHECK (eventually ([&] {
        lab.tick();
        static_cast<void> (other->read());
        return lab.reading.fault == ReadingFault::unplugged || lab.device->counts().departures > 0;
    }));
    other.reset();
    CHECK (lab.ticksUntil ([&] { return lab.reading.valid && lab.arms->process != process; }));
    CHECK (lab.arms->frame_errors == 0);
    CHECK (lab.arms->calls_after_unschedule == 0);
    CHECK (lab.arms->gets_outside_frames == 0);
}

TEST_CASE ("a trial of a Touch finds everything as expected, with at most 0.3 N, and measures its delay", "[openhaptics][trial]")
{
    TouchLab lab;
    auto options = TouchLab::patient();
    options.silence_s = 0.05;   // the trial stops its ticks on purpose
    REQUIRE (lab.opens ({}, options));
    REQUIRE (lab.ticksUntil ([&] { return lab.reading.valid; }));
    tactus::test::TrialHand hand;
    hand.move = [&] (const Vec3& to) {
        const double by_library[] { 1e3 * to.x(), 1e3 * to.z(), -1e3 * to.y() };
        for (std::size_t i = 0; i < 3; ++i)
            lab.arm().target[i] = by_library[i];
        REQUIRE (eventually ([&] {
            double off = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                off = std::max (off, std::abs (lab.arm().position[i] - by_library[i]));
            return off < 1.0;
        }));
    };
    hand.force = [&] { return Vec3 { lab.arm().force[0], -lab.arm().force[2], lab.arm().force[1] }; };
    const auto report = host::tryDevice (*lab.device, lab.limits, { .pace = 0.3 }, hand);
    INFO (host::trialText (report));
    for (const auto* step : tactus::test::steps_of_trial)
    {
        CAPTURE (step);
        CHECK (tactus::test::verdictOf (report, step) == "as expected");
    }
    CHECK (hand.largest > 0.1);
    CHECK (hand.largest <= host::trial_push);
    CHECK (contains (host::trialText (report), "by the driver: "));
    CHECK (report.at ("numbers").at ("delay_s").get<double>() > 0.0);
    CHECK (tactus::test::verdictOf (report, "walls") == "not tried");   // nothing tells the damping
    CHECK (host::trialNumbers (report, 1000.0)->delay->value >= 1.0);   // in ticks, rounded up
    CHECK (*host::replayTrial (report) == 0.0);
}
