// SPDX-License-Identifier: MIT
// The driver of the Falcon against one that was written apart from it and from the fake that is handed out: tests/host/drivers/apart.

#include "../apart/bench.hpp"
#include "../apart/falcon_apart.h"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <host/drivers/falcon/device.hpp>

#include <algorithm>
#include <string>

using namespace tactus;
using test::eventually;

namespace
{
struct Desk : test::ApartBench
{
    Desk() : ApartBench (host::falcon::patient_driver)
    {
        falcon.homed = 7;
        const double hand[] { 0.01, 0.005, 0.13 };   // right, up, away from the base
        std::copy_n (hand, 3, falcon.hand);
    }
    ~Desk()
    {
        device.reset();
        if (has_begun) falcon_apart_end (&falcon);
        CHECK (falcon.broken == 0);
        CHECK (falcon.unhomed == 0);
    }
    Desk (const Desk&) = delete;
    Desk& operator= (const Desk&) = delete;

    bool plays (Json description = Json::object())
    {
        if (! has_begun) REQUIRE (falcon_apart_begin (&falcon) == 0);
        has_begun = true;
        description["port"] = falcon.port;
        return opens (description);
    }

    bool pushes()
    {
        return ticksUntil ([&] { return falcon.motors[0] != 0; }, along (2));
    }

    falcon_apart falcon {};
    bool has_begun = false;
    const Vec3 middle { 0.01, 0.02, 0.005 };
};
}   // namespace

TEST_CASE ("another Falcon is read and pushed in its axes", "[falcon][apart]")
{
    Desk desk;
    REQUIRE (desk.plays());
    CHECK (desk.isPushed (desk.middle, 200.0));
    CHECK (desk.ticksUntil ([&] { return desk.falcon.lights == 2; }));
    desk.falcon.buttons = 9;
    CHECK (desk.ticksUntil ([&] { return desk.reading.buttons == 9; }));
    REQUIRE (desk.pushes());
    desk.device.reset();
    CHECK (eventually ([&] { return desk.falcon.motors[0] == 0; }));
}

TEST_CASE ("another Falcon gets its firmware, knows its place only once it is homed, and is pulled out", "[falcon][apart][safety]")
{
    const TemporaryFolder folder;
    folder.write ("image.bin", std::string (7324, '<') + std::string (1000, '\x41'));
    Desk desk;
    desk.falcon.needs_firmware = 1;
    desk.falcon.homed = 5;
    CHECK_FALSE (desk.plays());
    REQUIRE (desk.plays ({ { "firmware", (folder / "image.bin").string() } }));
    CHECK (desk.falcon.uploaded == 8324);
    CHECK (desk.tells (ReadingFault::not_homed));
    CHECK (desk.ticksUntil ([&] { return desk.falcon.lights == 8; }));
    desk.falcon.homed = 7;
    CHECK (desk.pushes());
    desk.has_begun = false;
    falcon_apart_end (&desk.falcon);
    CHECK (desk.tells (ReadingFault::unplugged));
}

TEST_CASE ("short answers of another Falcon give no wrong reading", "[falcon][apart][safety]")
{
    Desk desk;
    desk.falcon.shorten = 3;
    REQUIRE (desk.plays());
    REQUIRE (desk.reaches (desk.middle));
    const auto before = desk.device->counts().readings;
    CHECK (desk.ticksUntil ([&] {
        CHECK ((desk.reading.position - desk.middle).norm() < 2e-4);   // and some counts
        CHECK (desk.reading.buttons == 0);
        return desk.device->counts().readings > before + 100;
    }));
}
