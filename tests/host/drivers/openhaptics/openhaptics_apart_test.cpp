// SPDX-License-Identifier: MIT
// The driver of 3D Systems' arms against a library that was written apart from it and from the fake that is handed out: tests/host/drivers/apart.

#include "../apart/bench.hpp"
#include "../apart/hd_apart.h"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <host/drivers/openhaptics/touch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

using namespace tactus;
using test::eventually;

namespace
{
struct Lab : test::ApartBench
{
    Lab() : ApartBench (host::openhaptics::driver)
    {
        ::setenv ("LD_LIBRARY_PATH", (std::string (TACTUS_FAKE_LIBRARIES) + "/apart").c_str(), 1);
        arm.devices = 2;
        arm.motors = 3;
        arm.style = 2;
        const double hand[] { 20.0, 10.0, 30.0 };   // right, up, towards the person
        std::copy_n (hand, 3, arm.hand);
    }
    ~Lab()
    {
        device.reset();
        ::unsetenv ("LD_LIBRARY_PATH");
        ::unsetenv ("APART_HD");
        CHECK (arm.late == 0);
        CHECK (arm.misuse == 0);
        CHECK (arm.empty == 0);
    }
    Lab (const Lab&) = delete;
    Lab& operator= (const Lab&) = delete;

    bool pushes()
    {
        return ticksUntil ([&] { return arm.force[1] == 1.0; }, along (2));
    }

    TemporaryFolder folder;
    hd_apart& arm = test::sharedMemory<hd_apart> (folder / "arm", "APART_HD");
    const Vec3 middle { 0.02, -0.03, 0.01 };
};
}   // namespace

TEST_CASE ("a Touch behind another libHD is read and pushed in its axes, and rests at the end", "[openhaptics][apart]")
{
    Lab lab;
    lab.arm.refuses_null = GENERATE (0, 1);
    REQUIRE (lab.opens());
    CHECK (lab.about.limits.max_force == 3.3);
    CHECK (lab.about.about.find ("Touch, serial number S0000123") != std::string::npos);
    CHECK (lab.isPushed (lab.middle, 300.0));
    lab.arm.buttons = 2;
    CHECK (lab.ticksUntil ([&] { return lab.reading.buttons == 2; }));
    REQUIRE (lab.pushes());
    lab.device.reset();
    CHECK (lab.arm.force[1] == 0.0);
    CHECK (eventually ([&] { return lab.arm.disabled == 1; }));
    CHECK (lab.arm.stopped >= 1);
}

TEST_CASE ("a Premium behind another libHD turns, and its motors turn the stylus", "[openhaptics][apart]")
{
    Lab lab;
    lab.arm.motors = 6;
    lab.arm.turn = 0.5;   // about y, which points up
    REQUIRE (lab.opens ({ { "port", "Left" } }));
    REQUIRE (lab.ticksUntil ([&] { return lab.reading.valid; }));
    CHECK ((lab.reading.rotation - Vec3 (0.0, 0.0, 0.5)).norm() < 1e-9);
    Effort effort;
    effort.torque = { 0.05, 0.02, -0.1 };
    CHECK (lab.ticksUntil ([&] { return lab.arm.torque[0] == Approx (50.0) && lab.arm.torque[1] == Approx (-100.0) && lab.arm.torque[2] == Approx (-20.0); },
                           effort));   // mN m
}

TEST_CASE ("errors and stalls of another libHD are told, and end", "[openhaptics][apart][safety]")
{
    Lab lab;
    REQUIRE (lab.opens());
    REQUIRE (lab.pushes());
    SECTION ("warm motors")
    {
        lab.arm.error = 0x200;
        CHECK (lab.tells (ReadingFault::too_hot));
    }
    SECTION ("too fast")
    {
        lab.arm.error = 0x203;
        CHECK (lab.tells (ReadingFault::not_driven));
    }
    SECTION ("a stall of the servo loop") { lab.arm.stall_ms = 30; }
    SECTION ("the cable")
    {
        lab.arm.error = 0x302;
        CHECK (lab.tells (ReadingFault::unplugged));
    }
    CHECK (lab.pushes());
}

TEST_CASE ("a Touch behind another libHD is calibrated by itself, or by the inkwell", "[openhaptics][apart][safety]")
{
    Lab lab;
    lab.arm.style = GENERATE (2, 4);
    lab.arm.calibration = lab.arm.style == 4 ? 2 : 1;
    REQUIRE (lab.opens());
    if (lab.arm.style == 4)
    {
        CHECK (test::text (lab.messages).find ("put its stylus into the inkwell") != std::string::npos);
        CHECK (lab.tells (ReadingFault::not_homed));
        CHECK (lab.arm.force[1] == 0.0);
        lab.arm.calibration = 1;   // it is there
    }
    CHECK (lab.pushes());
    CHECK (lab.arm.calibrated == 1);
}
