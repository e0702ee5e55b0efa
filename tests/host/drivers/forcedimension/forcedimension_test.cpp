// SPDX-License-Identifier: MIT
// The driver of Force Dimension's arms against a fake of their library. Both are ours; no arm has been tried.

#include "../dry_wood.hpp"
#include "../trial_person.hpp"
#include "lab.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::Lab;

namespace
{
bool contains (const std::string& text, const char* part) { return text.find (part) != std::string::npos; }
}   // namespace

TEST_CASE ("an arm of Force Dimension is read and pushed in the axes of Tactus", "[forcedimension]")
{
    Lab lab;
    REQUIRE (lab.opens());
    CHECK (lab.limits.max_force == 12.0);
    CHECK (lab.device_watchdog_s == 255 * 125e-6);
    lab.arm().target[0] = 0.03;   // towards the person
    lab.arm().target[1] = 0.02;
    lab.arm().target[2] = 0.01;
    const auto is_at = [&] (const Vec3& place) { return (lab.reading.position - place).norm() < 5e-5; };
    const Vec3 middle { 0.02, -0.03, 0.01 };
    REQUIRE (lab.ticksUntil ([&] { return lab.reading.valid && is_at (middle); }));   // the weight is carried: the tool does not sag
    const int axis = GENERATE (0, 1, 2);
    Vec3 pushed = middle;
    pushed[axis] += 1.0 / 500.0;
    CHECK (lab.ticksUntil ([&] { return is_at (pushed); }, Lab::along (axis)));
    pushed[axis] -= 2.0 / 500.0;
    CHECK (lab.ticksUntil ([&] { return is_at (pushed); }, Lab::along (axis, -1.0)));
    CHECK (lab.arm().expert_violations == 0);

    // It ends by stop, wait, close.
    lab.device.reset();
    CHECK (lab.arm().stopped_before_close == 1);
    CHECK (lab.arm().closes == 1);
    CHECK (lab.arm().calls_after_close == 0);
    CHECK (lab.arm().is_enabled == 0);
}

TEST_CASE ("dry wood on an arm of Force Dimension has the forces of its render at the positions that the arm has rounded", "[forcedimension]")
{
    Lab lab;
    auto& arm = lab.arm();
    arm.is_stepped = 1;
    test::DryWood wood { host::forcedimension::eager_driver, Json::object() };
    CHECK (wood.about().limits.max_still == 1.0);   // its readings have neither a number nor a time
    CHECK (wood.about().limits.still_force == 0.5);
    const auto any = [] (const auto&, const auto&) { return true; };
    REQUIRE (eventually (0ns, [&] {   // its forces are enabled when it first looks at the status
        ++arm.step;
        wood.reads (any);
        return arm.is_enabled == 1;
    }));
    const auto before = arm.new_positions.load();
    const int readings = test::readings (30'000);
    for (int k = 0; k < readings; ++k)
    {
        const Vec3 at = test::DryWood::placeAt (k);
        const double by_library[] { -at.y(), at.x(), at.z() };
        for (std::size_t i = 0; i < 3; ++i)
            arm.target[i] = by_library[i];
        ++arm.step;
        const auto um = [] (double m) { return std::round (m / 1e-6) * 1e-6; };   // by hand, as the arm does
        const Vec3 asked = wood.tick ({ um (at.x()), -um (-at.y()), um (at.z()) }, any);
        INFO ("reading " << k << " asks for " << asked.transpose());
        REQUIRE (Vec3 (arm.force[1], -arm.force[0], arm.force[2]) == asked);
    }
    CHECK (wood.pushes() > readings / 4);
    CHECK_FALSE (wood.hasFailed());
    CHECK (arm.new_positions == before + static_cast<std::uint64_t> (readings));   // each is new once
}

TEST_CASE ("an arm of Force Dimension is found by number, serial number and model", "[forcedimension]")
{
    Lab lab;
    lab.arms->count = 2;
    lab.arm (1).type = 63;
    const auto is_open = [&] { return std::pair (lab.arm (0).is_open.load(), lab.arm (1).is_open.load()); };
    REQUIRE (lab.opens ({ { "port", "1" } }));
    CHECK (is_open() == std::pair (0, 1));
    CHECK (lab.limits.max_force == 20.0);
    REQUIRE (lab.opens ({ { "port", "sn=10001" } }));
    CHECK (is_open() == std::pair (1, 0));
    REQUIRE (lab.opens ({ { "port", "delta.3" } }));
    CHECK (is_open() == std::pair (0, 1));

    // Without a port, the first one that is free.
    Lab other;
    other.arms->count = 2;
    other.arm (0).is_open = 1;
    REQUIRE (other.opens());
    CHECK (other.arm (1).is_open == 1);
    CHECK (contains (other.said ({ { "port", "0" } }), "device in use"));
    CHECK (contains (other.said ({ { "port", "sn=7" } }), "no arm with the serial number 7 can be opened: no device found"));
    CHECK (contains (other.said ({ { "port", "sigma.7" } }), "no sigma.7"));
    CHECK (contains (other.said ({ { "port", "omega" } }), "a model such as omega.3"));
    CHECK (contains (other.said ({ { "port", "sn=70000" } }), "serial number"));
    CHECK (contains (other.said ({ { "calibrate", 1 } }), "calibrate"));
    CHECK (contains (other.said ({ { "colour", "red" } }), "colour"));
    other.arms->count = -1;
    CHECK (contains (other.said(), "no arm can be opened: no device found (error 5 of its library). Connected arms: 0"));
}

TEST_CASE ("the driver of Force Dimension's arms lists those that are free, and touches none while one is open", "[forcedimension][safety]")
{
    Lab lab;
    lab.arms->count = 2;
    lab.arm (1).type = 60;   // all Falcons have the same serial number
    lab.arm (1).serial = 65535;
    const auto driver = host::DeviceDriver::within (host::forcedimension::driver);
    REQUIRE (driver);
    const auto found = [&] {
        auto all = (*driver)->find();
        REQUIRE (all);
        REQUIRE (all->size() == 2);
        return std::move (*all);
    };
    auto all = found();
    CHECK (all[0].name == "omega.3 of Force Dimension, number 0");
    CHECK (all[0].description == Json { { "driver", "forcedimension" }, { "port", "sn=10001" } });
    CHECK (all[1].name == "Falcon of Force Dimension, number 1");
    CHECK (all[1].description == Json { { "driver", "forcedimension" }, { "port", "1" } });
    for (const int i : { 0, 1 })
    {
        CHECK (lab.arm (i).stopped_before_close == 1);
        CHECK (lab.arm (i).closes == 1);
        CHECK (lab.arm (i).enables == 0);
        CHECK (lab.arm (i).forces == 0);
        CHECK (lab.arm (i).calibrations == 0);
    }

    lab.arm (1).is_open = 1;   // by another program
    all = found();
    CHECK (all[1].is_in_use);
    CHECK (all[1].description["port"] == Json ("1"));
    lab.arm (1).is_open = 0;

    REQUIRE (lab.opens ({ { "port", "0" } }));
    REQUIRE (lab.pushes());
    const auto closes = lab.arm (1).closes.load();
    all = found();
    CHECK_FALSE (all[0].is_seen);
    CHECK_FALSE (all[1].is_seen);
    CHECK (lab.arm (0).is_enabled == 1);
    CHECK (lab.arm (1).closes == closes);
    lab.device.reset();

    lab.arms->count = -1;
    CHECK ((*driver)->find()->empty());
    Lab old { "libfake_old_dhd.so", "libdhd.so.3.2.1" };
    const auto none = (*driver)->find();
    CHECK ((none ? none->size() == 1 : none.error().id == "device/cannot_find"));
    Lab without { nullptr };
    REQUIRE_FALSE ((*driver)->find());
    CHECK (contains ((*driver)->find().error().text, "set FDSDK to its folder"));
}

TEST_CASE ("the wrist and the gripper of a left-handed arm turn, press and pull as those of a right-handed one", "[forcedimension]")
{
    Lab lab;
    const bool is_left = GENERATE (false, true);
    auto& arm = lab.arm();
    arm.type = is_left ? 105 : 104;
    arm.left_handed = is_left ? 1 : 0;
    arm.wrist = arm.active_wrist = arm.gripper = arm.active_gripper = 1;
    arm.gripper_angle = 0.25;
    // Turned by 2 rad about (1, 2, 2)/3 of the library.
    const Vec3 axis { 1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0 };
    const double angle = GENERATE (2.0, 1e-9, 3.1415926);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
        {
            const int third = 3 - row - column;
            const double cross = row == column ? 0.0 : ((column - row + 3) % 3 == 1 ? -1.0 : 1.0) * axis[third];
            arm.frame[static_cast<std::size_t> (3 * row + column)] =
                (row == column ? std::cos (angle) : 0.0) + (1.0 - std::cos (angle)) * axis[row] * axis[column] + std::sin (angle) * cross;
        }
    arm.buttons = 5;
    REQUIRE (lab.opens());
    const auto layout = lab.device->layout();
    CHECK (layout.axes == std::vector<std::string> { "saturated", "gripper_angle", "gripper" });
    CHECK (layout.efforts == std::vector<std::string> { "gripper" });
    REQUIRE (lab.reads());
    CHECK ((lab.reading.rotation - angle * Vec3 (axis.y(), -axis.x(), axis.z())).norm() < 1e-7);
    CHECK (lab.reading.axes[1] == 0.25);
    CHECK (lab.reading.axes[2] == Approx (0.015));
    CHECK (lab.reading.buttons == 5);

    Effort effort;
    effort.torque = { 0.05, 0.0, -0.1 };
    effort.axes.set (0, 2.0);
    CHECK (lab.ticksUntil (
        [&] { return arm.torque[1] == 0.05 && arm.torque[0] == 0.0 && arm.torque[2] == -0.1 && arm.gripper_force == (is_left ? -2.0 : 2.0); },
        effort));
}

TEST_CASE ("an arm of Force Dimension counts a position only if it is new, and keeps its weight while nobody ticks", "[forcedimension][safety]")
{
    Lab lab;
    auto& arm = lab.arm();
    arm.time_guard_us = 20'000;
    REQUIRE (lab.opens());
    REQUIRE (lab.ticksUntil ([&] { return arm.new_positions >= 20; }));
    // The one that the library has measured last may not have come yet.
    const auto measured = arm.new_positions.load();
    CHECK (lab.device->counts().readings <= arm.new_positions);
    CHECK (eventually ([&] { return lab.device->counts().readings + 1 >= measured; }));
    CHECK (lab.device->counts().held_up == 0);

    // Nobody ticks: the library gets zeros all the same, so the weight is carried and the watchdog does not bite.
    const auto forces = arm.forces.load();
    CHECK (eventually ([&] { return arm.forces > forces + 100; }));
    CHECK (arm.force[2] == 0.0);
    CHECK (arm.is_enabled == 1);
}

TEST_CASE ("an arm of Force Dimension whose forces go off says why, and nothing switches them on again", "[forcedimension][safety]")
{
    Lab lab;
    auto& arm = lab.arm();
    const auto [cause, count, fault] = GENERATE (table<int, int, ReadingFault> ({ { 1, 17, ReadingFault::stopped },
                                                                                  { 2, 17, ReadingFault::not_driven },
                                                                                  { 3, 16, ReadingFault::timed_out },
                                                                                  { 4, 17, ReadingFault::not_driven },
                                                                                  { 6, 15, ReadingFault::stopped },
                                                                                  { 1, 14, ReadingFault::not_driven },
                                                                                  { 3, 12, ReadingFault::not_driven } }));
    INFO ("cause " << cause << ", " << count << " numbers of the status");
    arm.status_count = count;
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    REQUIRE (arm.enables == 1);
    arm.off_cause = cause;
    CHECK (lab.ticksUntil ([&, wanted = fault] { return lab.reading.fault == wanted && ! lab.reading.valid; }, Lab::along (2)));
    CHECK (lab.ticksUntil ([&] { return arm.force[2] == 0.0; }, Lab::along (2)));   // what is asked for, too
    const auto readings = lab.device->counts().readings;
    CHECK (lab.ticksUntil ([&] { return lab.device->counts().readings > readings + 200; }, Lab::along (2)));
    CHECK (arm.enables == 1);
    CHECK (lab.acting() == 0.0);
    CHECK (lab.device->counts().departures == 0);

    // A person starts again.
    REQUIRE (lab.opens());
    CHECK (lab.pushes());
    CHECK (arm.enables == 2);
}

TEST_CASE ("an arm of Force Dimension that is too fast brakes, and that is a stop", "[forcedimension][safety]")
{
    Lab lab;
    auto& arm = lab.arm();
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    arm.max_speed = 0.05;
    arm.target[0] = 0.1;   // the hand jumps
    CHECK (lab.ticksUntil ([&] { return arm.cause == 2 && lab.reading.fault == ReadingFault::not_driven; }, Lab::along (2)));
    CHECK (arm.is_braked == 1);
    CHECK (lab.acting() == 0.0);
}

TEST_CASE ("an arm of Force Dimension with an error, or without power, is not trusted", "[forcedimension][safety]")
{
    Lab lab;
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    lab.arm().error_flag = 1;
    CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::failed; }));
    lab.arm().error_flag = 0;
    lab.arm().has_no_power = 1;
    CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_driven; }));
    lab.arm().has_no_power = 0;
    CHECK (lab.pushes());
}

TEST_CASE ("a call of Force Dimension's library that fails is not passed over", "[forcedimension][safety]")
{
    Lab lab;
    auto& arm = lab.arm();
    SECTION ("its status, from the start: nothing says that the arm knows its position")
    {
        arm.has_no_status = 1;
        REQUIRE (lab.opens());
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_homed; }, Lab::along (2)));
        CHECK (arm.enables == 0);
        arm.has_no_status = 0;
        CHECK (lab.pushes());
    }
    SECTION ("its status, later: nothing says whether its forces are on")
    {
        REQUIRE (lab.opens());
        REQUIRE (lab.pushes());
        arm.has_no_status = 1;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::failed && arm.force[2] == 0.0; }, Lab::along (2)));
        arm.has_no_status = 0;
        CHECK (lab.pushes());
        CHECK (arm.enables == 1);
    }
    SECTION ("the opening of a gripper that has none")
    {
        arm.gripper = arm.has_no_gap = 1;
        REQUIRE (lab.opens());
        CHECK (lab.device->layout().axes == std::vector<std::string> { "saturated", "gripper_angle" });
        CHECK (lab.reads());
    }
    SECTION ("a part of each reading")
    {
        arm.gripper = 1;
        auto options = Lab::patient();
        options.look_again = std::chrono::hours (1);
        REQUIRE (lab.opens (Json::object(), options));
        REQUIRE (lab.pushes());
        arm.gripper_fails = 1;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::unplugged; }));
        CHECK (contains (lab.device->trouble(), "it does not answer: an error (error 6 of its library)"));
    }
}

TEST_CASE ("motors that are saturated are an axis of an arm of Force Dimension, and no error", "[forcedimension]")
{
    Lab lab;
    auto& arm = lab.arm();
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    CHECK (lab.reading.axes[0] == 0.0);
    arm.max_force = 3.0;   // since it was opened
    CHECK (lab.ticksUntil ([&] { return lab.reading.axes[0] == 1.0; }, Lab::along (2, 5.0)));
    CHECK (arm.force[2] == Approx (3.0));
    CHECK (lab.ticksUntil ([&] { return lab.reading.axes[0] == 0.0; }, Lab::along (2, 2.0)));
    CHECK (lab.device->counts().write_errors == 0);

    REQUIRE (lab.opens());   // now the library says so from the start
    CHECK (lab.limits.max_force == 3.0);
}

TEST_CASE ("an arm of Force Dimension that is unplugged, or does not answer, is opened again, with a force from zero", "[forcedimension][safety]")
{
    Lab lab;
    auto& arm = lab.arm();
    const bool is_silent = GENERATE (false, true);
    auto& fault = is_silent ? arm.is_muted : arm.is_unplugged;
    const bool looks_again = GENERATE (false, true);   // the reason is told until it has looked, which may be before this test has
    auto options = Lab::patient();
    if (! looks_again) options.look_again = std::chrono::hours (1);
    REQUIRE (lab.opens (Json::object(), options));
    REQUIRE (lab.pushes());
    fault = 1;
    CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::unplugged; }, Lab::along (2)));
    CHECK (lab.device->counts().departures == 1);
    if (! looks_again)
    {
        CHECK (contains (lab.device->trouble(), is_silent ? "does not answer: communication error" : "it was unplugged"));
        return;
    }
    fault = 0;
    CHECK (lab.pushes());
    CHECK (arm.enables == 2);
    CHECK (arm.closes == 1);
}

TEST_CASE ("a call of Force Dimension's library that takes long costs a stop, and one that never returns costs the arm", "[forcedimension][safety]")
{
    Lab lab;
    auto& arm = lab.arm();
    const auto options = host::PluginDevice::Options { .silence_s = 0.02, .look_again = 2ms, .patience = 200ms, .real_time = false };
    REQUIRE (lab.opens (Json::object(), options));

    SECTION ("a reading that takes 30 ms is one that comes late")
    {
        REQUIRE (lab.reads());
        arm.read_stall_ms = 30;
        CHECK (lab.ticksUntil ([&] { return arm.read_stall_ms == 0 && lab.device->counts().oldest > 0.02; }));
        CHECK (lab.device->counts().departures == 0);
    }
    SECTION ("a reading that takes 2 s")
    {
        REQUIRE (lab.reads());
        arm.read_stall_ms = 2000;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::stuck; }));
        CHECK (contains (lab.device->trouble(), "has not returned from `read`"));
        CHECK (lab.ticksUntil ([&] { return lab.acting() == 0.0; }, Lab::along (2)));   // long before it returns
        CHECK (lab.pushes());
    }
    SECTION ("an effort that never arrives")
    {
        REQUIRE (lab.reads());
        arm.write_stall_ms = -1;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::stuck; }, Lab::along (2)));
        CHECK (lab.acting() == 0.0);
        lab.device.reset();   // does not wait for ever
        CHECK (arm.closes == 0);
        arm.write_stall_ms = 0;
        CHECK (eventually ([&] { return arm.closes == 1; }));
        CHECK (arm.stopped_before_close == 1);
    }
    SECTION ("closing that never ends")
    {
        REQUIRE (lab.reads());
        arm.close_stall_ms = -1;
        lab.device.reset();
        CHECK (arm.stopped_before_close == 1);
        arm.close_stall_ms = 0;
        CHECK (eventually ([&] { return arm.closes == 1; }));
    }
    lab.device.reset();
    CHECK (eventually ([&] { return arm.is_open == 0; }));
}

TEST_CASE ("an arm of Force Dimension moves by motor only if a person has asked for it", "[forcedimension][safety]")
{
    Lab lab;
    auto& arm = lab.arm();
    arm.must_calibrate = 1;

    SECTION ("nobody has")
    {
        CHECK (contains (lab.said(), R"(the arm is not calibrated, so it has no force. With "calibrate": true, its motors move it)"));
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_homed; }));
        CHECK (arm.calibrations == 0);
        CHECK (arm.enables == 0);
        arm.is_calibrated = 1;   // by another program, or by hand
        CHECK (lab.pushes());
        CHECK (arm.enables == 1);
    }
    SECTION ("somebody has")
    {
        CHECK (lab.said ({ { "calibrate", true } }).empty());
        CHECK (arm.calibrations == 1);
        CHECK (lab.pushes());

        // It comes back without power in between, and nobody has asked for that.
        arm.is_unplugged = 1;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::unplugged; }));
        arm.is_calibrated = 0;
        arm.is_unplugged = 0;
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_homed; }));
        CHECK (arm.calibrations == 1);
    }
    SECTION ("it can only be moved by hand")
    {
        arm.calibrates_by_hand = 1;
        CHECK (contains (lab.said ({ { "calibrate", true } }), "Move each axis to both of its ends by hand"));
        CHECK (arm.calibrations == 0);
        CHECK (lab.ticksUntil ([&] { return lab.reading.fault == ReadingFault::not_homed; }));
        arm.is_calibrated = 1;
        CHECK (lab.pushes());
    }
}

TEST_CASE ("old libraries and arms of Force Dimension are used as far as they go, or refused with the reason", "[forcedimension][safety]")
{
    SECTION ("firmware without a watchdog")
    {
        Lab lab;
        const bool is_told = GENERATE (true, false);
        lab.arm().watchdog = is_told ? -1 : 255;
        lab.arm().firmware = 2.4;   // the library may give a number all the same
        CHECK (contains (lab.said(), "the arm has no force: it has no watchdog, or one that is off, so it would keep its last force if this program died"));
        CHECK_FALSE (lab.limits.max_force < GuardLimits::none);
        CHECK (lab.reads());
        CHECK (lab.arm().forces == 0);
        CHECK (lab.arm().enables == 0);
    }
    SECTION ("a library without functions of robots and of the watchdog")
    {
        Lab lab { "libfake_old_dhd.so", "libdhd.so.3.2.1" };
        lab.arm().wrist = 1;
        lab.arm().buttons = 9;
        CHECK (contains (lab.said(), "it has no watchdog"));
        CHECK (lab.reads());
        CHECK (lab.reading.buttons == 9);       // asked one by one
        CHECK (lab.device->about().rotation);   // by the name that the function had
        CHECK (contains (lab.device->about().about, "An arm of Force Dimension, library 3.2.1."));
        CHECK (contains (lab.said ({ { "port", "sn=10001" } }), "3.2.1, does not find arms by serial number, so none can be opened"));
        CHECK (contains (lab.said ({ { "port", "omega.3" } }), "no omega.3"));
    }
    SECTION ("one from before versions")
    {
        Lab lab { "libfake_ancient_dhd.so", "libdhd.so" };
        CHECK (contains (lab.said(), "this version is too old: it lacks dhdEnableForce or dhdGetSDKVersion"));
    }
    SECTION ("none")
    {
        Lab lab { nullptr };
        const auto said = lab.said();
        CHECK (contains (said, "set FDSDK to its folder: neither libdrd.so nor libdhd.so is in"));
        CHECK (contains (said, (lab.folder.path() / "sdk").c_str()));
    }
    SECTION ("one that needs a library that is not there")
    {
        Lab lab { "libfake_needy_drd.so" };
        CHECK (contains (lab.said(), "libneeded_by_fake.so: cannot open shared object file: No such file or directory"));
    }
    SECTION ("one that is only in a folder of LD_LIBRARY_PATH")
    {
        Lab lab { nullptr };
        std::filesystem::create_symlink (std::filesystem::path (TACTUS_FAKE_LIBRARIES) / "libfake_drd.so", lab.folder / "libdrd.so");
        ::setenv ("LD_LIBRARY_PATH", ("/nowhere::" + lab.folder.path().string()).c_str(), 1);
        CHECK (lab.opens());
        ::unsetenv ("LD_LIBRARY_PATH");
    }
    SECTION ("the newest by number, and the next one if it cannot be loaded")
    {
        Lab lab { "libfake_needy_drd.so", "libdrd.so.3.17.5" };
        lab.install ("libfake_ancient_dhd.so", "libdrd.so.3.2");
        lab.install ("libfake_drd.so", "libdrd.so.3.9.1");
        CHECK (lab.opens());
        lab.device.reset();
        Lab text_order { "libfake_drd.so", "libdrd.so.3.17.5" };
        text_order.install ("libfake_needy_drd.so", "libdrd.so.3.9.1");
        text_order.install ("libfake_ancient_dhd.so", "libdhd.so.4");   // libdrd comes first
        CHECK (text_order.said().empty());
    }
}

TEST_CASE ("a Falcon behind Force Dimension's library has its own buttons and no serial number", "[forcedimension]")
{
    Lab lab;
    lab.arm().type = 60;
    lab.arm().serial = 65535;
    REQUIRE (lab.opens ({ { "port", "falcon" } }));
    CHECK (lab.limits.max_force == 8.0);
    CHECK (lab.device->layout().buttons == std::vector<std::string> { "center", "left", "up", "right" });
    CHECK (lab.device->about().about == "Falcon of Force Dimension, firmware 3.1, library 3.17.5.");
}

TEST_CASE ("a trial of an arm of Force Dimension finds everything as expected, with at most 0.3 N, and its capture replays", "[forcedimension][trial]")
{
    Lab lab;
    auto options = Lab::patient();
    options.silence_s = 0.05;   // the trial stops its ticks on purpose
    REQUIRE (lab.opens (Json::object(), options));
    REQUIRE (lab.reads());
    test::TrialHand hand;
    hand.move = [&] (const Vec3& to) {
        const double by_library[] { -to.y(), to.x(), to.z() };
        for (std::size_t i = 0; i < 3; ++i)
            lab.arm().target[i] = by_library[i];
        REQUIRE (eventually ([&] {
            double off = 0.0;
            for (std::size_t i = 0; i < 3; ++i)
                off = std::max (off, std::abs (lab.arm().position[i] - by_library[i]));
            return off < 1e-3;
        }));
    };
    hand.force = [&] { return Vec3 { lab.arm().force[1], -lab.arm().force[0], lab.arm().force[2] }; };
    lab.arm().damping = 2.0;
    hand.release = [&] (bool is_free) { lab.arm().stiffness = is_free ? 1e-9 : 500.0; };
    hand.lean = [&] { lab.arm().target[2] = -0.007; };
    hand.unplug = [&] { lab.arm().is_unplugged = 1; };
    const auto report = host::tryDevice (*lab.device, lab.limits, { .pace = 0.3 }, hand);
    INFO (host::trialText (report));
    for (const auto* step : test::steps_of_trial)
    {
        CAPTURE (step);
        CHECK (test::verdictOf (report, step) == "as expected");
    }
    CHECK (hand.largest > 0.1);
    CHECK (hand.largest <= host::trial_push);
    CHECK (test::verdictOf (report, "a pulled cable") == "as expected");

    // The arm lives in real time, and a busy computer reads it at other times than it thinks: then nothing is told, but nothing wrong.
    if (test::verdictOf (report, "damping") == "measured")
    {
        const double least = report.at ("numbers").at ("damping").get<double>();
        CHECK (least <= 2.0);
        CHECK ((least <= 0.0) == (test::verdictOf (report, "walls") == "not tried"));
        CHECK (hand.largest_at_wall <= host::trial_wall);
        CHECK ((least <= 0.0 || hand.largest_at_wall > 0.3));
    }
    else
    {
        CHECK (contains (host::trialText (report), "damping: not tried; it is not known: "));
        CHECK (test::verdictOf (report, "walls") == "not tried");
    }
    std::cout << "the damping of the fake arm, 2 N s/m: " << host::trialText (report).substr (host::trialText (report).find ("damping: "), 200) << "\n";
    const auto replayed = host::replayTrial (report);
    REQUIRE (replayed);
    CHECK (*replayed == 0.0);
}
