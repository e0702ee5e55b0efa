// SPDX-License-Identifier: MIT
// The driver of Force Dimension's arms against a library that was written apart from it and from the fake that is handed out: tests/host/drivers/apart.

#include "../apart/bench.hpp"
#include "../apart/drd_apart.h"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <host/drivers/forcedimension/arm.hpp>

#include <sys/utsname.h>

#include <cstdlib>
#include <filesystem>
#include <string>

using namespace tactus;
using test::eventually;

namespace
{
struct Lab : test::ApartBench
{
    Lab() : ApartBench (host::forcedimension::driver)
    {
        utsname machine {};
        ::uname (&machine);
        const auto to = folder / "sdk" / "lib/release" / ("lin-" + std::string (machine.machine) + "-gcc");
        std::filesystem::create_directories (to);
        std::filesystem::create_symlink (std::filesystem::path (TACTUS_FAKE_LIBRARIES) / "apart/libdrd.so", to / "libdrd.so.3.17.5");
        ::setenv ("FDSDK", (folder / "sdk").c_str(), 1);
        arm.devices = 1;
        arm.serial = 4711;
        arm.homed = 1;
        arm.watchdog = 200;
        arm.status_entries = 17;
        arm.clock_hz = 1000.0;   // a busy computer must not look like a silent program
        arm.mass = 0.2;
        const double hand[] { 0.03, 0.02, 0.01 };   // towards the person, to the right, up
        std::copy_n (hand, 3, arm.hand);
    }
    ~Lab()
    {
        device.reset();
        ::unsetenv ("FDSDK");
        ::unsetenv ("APART_DRD");
        CHECK (arm.after_close == 0);
        CHECK (arm.outside == 0);
        CHECK (arm.stopped >= arm.closed);
    }
    Lab (const Lab&) = delete;
    Lab& operator= (const Lab&) = delete;

    bool pushes()
    {
        return ticksUntil ([&] { return arm.force[2] == 1.0; }, along (2));
    }

    TemporaryFolder folder;
    drd_apart& arm = test::sharedMemory<drd_apart> (folder / "arm", "APART_DRD");
    const Vec3 middle { 0.02, -0.03, 0.01 };
};
}   // namespace

TEST_CASE ("an arm behind another libdrd is read and pushed in its axes, carries its weight, and rests at the end", "[forcedimension][apart]")
{
    Lab lab;
    lab.arm.status_entries = GENERATE (12, 16, 17);
    lab.arm.guard_us = lab.arm.status_entries == 16 ? 2000 : 0;
    REQUIRE (lab.opens());
    CHECK (lab.about.device_watchdog_s == 200 * 125e-6);
    CHECK (lab.about.about.find ("omega.3") != std::string::npos);
    CHECK (lab.isPushed (lab.middle, 300.0));
    lab.arm.buttons = 5;
    CHECK (lab.ticksUntil ([&] { return lab.reading.buttons == 5; }));
    CHECK (lab.device->counts().readings <= static_cast<std::uint64_t> (lab.arm.fresh));
    lab.device.reset();
    CHECK (lab.arm.stopped == 1);
    CHECK (lab.arm.closed == 1);
    CHECK (lab.arm.calibrated == 0);
    CHECK (lab.arm.force[2] == 0.0);
}

TEST_CASE ("the reasons of another libdrd to take forces off are named, and nothing enables them again", "[forcedimension][apart][safety]")
{
    Lab lab;
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    const auto enabled = lab.arm.enabled;
    const auto [cause, fault] = GENERATE (std::pair (1, ReadingFault::stopped), std::pair (2, ReadingFault::not_driven), std::pair (3, ReadingFault::timed_out),
                                          std::pair (6, ReadingFault::stopped));
    lab.arm.cause = cause;
    CHECK (lab.tells (fault));
    lab.arm.cause = 0;
    const auto forces = lab.arm.forces;
    CHECK (lab.ticksUntil ([&] { return lab.arm.forces > forces + 200; }, Lab::along (2)));
    CHECK (lab.arm.enabled == enabled);
    CHECK (lab.arm.force[2] == 0.0);
}

TEST_CASE ("an arm behind another libdrd that stalls goes on, and one that is pulled out is opened again", "[forcedimension][apart][safety]")
{
    Lab lab;
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    lab.arm.stall_ms = 50;
    const auto readings = lab.device->counts().readings;
    CHECK (lab.ticksUntil ([&] { return lab.arm.stall_ms == 0 && lab.device->counts().readings > readings + 100; }));
    CHECK (lab.device->counts().departures == 0);
    lab.arm.gone = 1;
    CHECK (lab.tells (ReadingFault::unplugged));
    lab.arm.gone = 0;
    CHECK (lab.pushes());
}

TEST_CASE ("an arm behind another libdrd moves by itself only if a person asks, and has no force without a watchdog", "[forcedimension][apart][safety]")
{
    Lab lab;
    SECTION ("not homed")
    {
        lab.arm.homed = 0;
        REQUIRE (lab.opens());
        CHECK (lab.tells (ReadingFault::not_homed));
        CHECK (lab.arm.calibrated == 0);
        CHECK (lab.arm.commanded[2] == 0.0);
    }
    SECTION ("asked for")
    {
        lab.arm.homed = 0;
        REQUIRE (lab.opens ({ { "calibrate", true } }));
        CHECK (lab.arm.calibrated == 1);
        CHECK (lab.pushes());
    }
    SECTION ("old firmware")
    {
        lab.arm.watchdog = 0;
        REQUIRE (lab.opens());
        CHECK (test::text (lab.messages).find ("the arm has no force") != std::string::npos);
        CHECK (lab.ticksUntil ([&] { return lab.reading.valid; }));
        CHECK (lab.arm.enabled == 0);
    }
}

TEST_CASE ("a left-handed sigma.7 behind another libdrd turns, presses and saturates", "[forcedimension][apart]")
{
    Lab lab;
    lab.arm.wrist = lab.arm.gripper = 2;
    lab.arm.left = GENERATE (0, 1);
    lab.arm.angle = 0.3;
    lab.arm.strongest = 2.0;
    const double turned[] { 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0 };   // by 90 degrees about z
    std::copy_n (turned, 9, lab.arm.frame);
    REQUIRE (lab.opens());
    REQUIRE (lab.ticksUntil ([&] { return lab.reading.valid && lab.reading.axes[1] == Approx (0.3); }));
    CHECK ((lab.reading.rotation - Vec3 (0.0, 0.0, std::acos (0.0))).norm() < 1e-9);
    Effort effort = Lab::along (2);
    effort.torque = { 0.01, 0.0, -0.02 };
    effort.axes.set (0, 0.5);
    CHECK (lab.ticksUntil ([&] { return lab.arm.torque[1] == 0.01 && lab.arm.torque[2] == -0.02 && lab.arm.grip == 0.5; }, effort));
    CHECK (lab.ticksUntil ([&] { return lab.reading.axes[0] == 1.0; }, Lab::along (0, 5.0)));
    CHECK (lab.ticksUntil ([&] { return lab.reading.axes[0] == 0.0; }));
}

TEST_CASE ("arms behind another libdrd are found by number, serial number and model", "[forcedimension][apart]")
{
    Lab lab;
    lab.arm.devices = 2;
    CHECK (lab.opens ({ { "port", "1" } }));
    CHECK (lab.opens ({ { "port", "sn=4712" } }));
    CHECK (lab.opens ({ { "port", "omega.3" } }));
    CHECK (lab.pushes());
    CHECK_FALSE (lab.opens ({ { "port", "sn=4713" } }));
    lab.arm.busy = 1;
    CHECK_FALSE (lab.opens ({ { "port", "0" } }));
    CHECK (test::text (lab.messages).find ("device in use") != std::string::npos);
    CHECK (lab.opens());   // the other one
    lab.device.reset();
    const auto loaded = host::DeviceDriver::within (host::forcedimension::driver);
    REQUIRE (loaded);
    const auto all = (*loaded)->find();
    REQUIRE (all);
    REQUIRE (all->size() == 2);
    CHECK ((*all)[0].is_in_use);
    CHECK ((*all)[1].description["port"] == Json ("sn=4712"));
}
