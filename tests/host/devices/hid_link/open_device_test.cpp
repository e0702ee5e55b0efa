// SPDX-License-Identifier: MIT
// How a description becomes a real device, and the errors if this fails.

#include "fake_board.hpp"

#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/udev_rule.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::hid;
using test::FakeBoard;

namespace
{
struct Several final : HidSystem
{
    std::vector<ConnectedDevice> connected() override { return devices; }
    Result<std::unique_ptr<Transport>> open (const ConnectedDevice&) override { return Message::error ("hid/not_opened", {}, "no such device"); }

    std::vector<ConnectedDevice> devices;
};

ConnectedDevice board (const std::string& path, const std::string& serial)
{
    ConnectedDevice d;
    d.vid = 0x1209;
    d.pid = 1;
    d.product = "Board";
    d.path = path;
    d.serial = serial;
    return d;
}

LoadedProfiles profiles() { return { .profiles = { test::BoardProfile { .watchdog = 0.02 }.make() }, .messages = {} }; }

std::string idOf (const Messages& messages) { return messages.empty() ? "" : messages.front().id; }
}   // namespace

TEST_CASE ("a description opens the device that its profile fits, and can only tighten its limits", "[hid]")
{
    FakeBoard there;
    for (const auto* profile : { "board", "auto" })
    {
        const auto made =
            openDevice ({ { "driver", "hid" }, { "profile", profile }, { "guard", { { "max_force", 1.0 }, { "watchdog", 5.0 }, { "ramp", 0.5 } } } }, {}, there,
                        profiles());
        CHECK (idOf (made.messages).empty());
        REQUIRE (made.device);
        CHECK (made.limits.max_force == 1.0);
        CHECK (made.limits.watchdog == 0.02);
        CHECK (made.limits.ramp == 0.5);
    }
    const auto loose = openDevice ({ { "driver", "hid" }, { "guard", { { "max_force", 50.0 } } } }, {}, there, profiles());
    CHECK (loose.limits.max_force == 3.0);
}

TEST_CASE ("the messages about a user's profile are reported when it opens a device", "[hid]")
{
    Several one;
    one.devices = { board ("/dev/hidraw0", "A") };
    auto profile = *test::BoardProfile {}.make();
    profile.file = "own/board.json";
    LoadedProfiles all { .profiles = { std::make_shared<const Profile> (profile) }, .messages = {} };
    for (const auto* file : { "own/board.json", "own/another.json" })
    {
        all.messages.push_back (Message::warning ("profile/replaces", "/replaces", "the profile replaces the shipped one"));
        all.messages.back().file = file;
    }

    const auto found = findDevice ({ { "driver", "hid" } }, one, all);
    REQUIRE (found.messages.size() == 1);
    CHECK (found.messages[0].id == "profile/replaces");
    CHECK (found.messages[0].text == "own/board.json/replaces: the profile replaces the shipped one");
    CHECK_FALSE (hasErrors (found.messages));

    profile.wires.serial.emplace();
    all.profiles = { std::make_shared<const Profile> (profile) };
    const auto on_a_line = findDevice ({ { "driver", "serial" }, { "profile", "board" }, { "port", "/dev/null" } }, one, all);
    REQUIRE (on_a_line.messages.size() == 1);
    CHECK (on_a_line.messages[0].text == "own/board.json/replaces: the profile replaces the shipped one");
}

TEST_CASE ("a profile with efforts but without a ramp and watchdog gets the defaults", "[hid]")
{
    auto profile = *test::BoardProfile {}.make();
    profile.limits.guard = {};
    CHECK (limitsOf (profile, {}).ramp > 0.0);
    CHECK (limitsOf (profile, {}).watchdog == GuardLimits::default_watchdog);
    profile.outputs.clear();
    CHECK (limitsOf (profile, {}).watchdog == GuardLimits::none);
}

TEST_CASE ("a device that cannot be opened gives an error with a remedy", "[hid]")
{
    Several none, two, one_twice;
    two.devices = { board ("/dev/hidraw0", "A"), board ("/dev/hidraw1", "B") };
    one_twice.devices = { board ("/dev/hidraw0", "A"), board ("/dev/hidraw1", "A") };
    const Json plain { { "driver", "hid" }, { "profile", "board" } };

    CHECK (idOf (findDevice (plain, none, profiles()).messages) == "hid/not_connected");
    CHECK (idOf (findDevice ({ { "driver", "hid" }, { "profile", "bord" } }, none, profiles()).messages) == "hid/unknown_profile");
    CHECK (findDevice ({ { "driver", "hid" }, { "profile", "bord" } }, none, profiles()).messages.front().remedy.find ("board") != std::string::npos);
    CHECK (idOf (findDevice ({ { "driver", "hid" }, { "wrong", 1 } }, two, profiles()).messages) == "device/unknown_key");
    CHECK (idOf (findDevice ({ { "driver", "hid" }, { "serial", "C" } }, two, profiles()).messages) == "hid/not_connected");
    CHECK (idOf (openDevice (plain, {}, one_twice, profiles()).messages) == "hid/not_opened");

    const auto several = findDevice (plain, two, profiles());
    CHECK (idOf (several.messages) == "hid/several");
    CHECK (several.messages.front().text.find ("serial B") != std::string::npos);
    const auto chosen = findDevice ({ { "driver", "hid" }, { "serial", "B" } }, two, profiles());
    CHECK (chosen.messages.empty());
    CHECK (chosen.device.path == "/dev/hidraw1");

    FakeBoard forbidden;
    forbidden.forbid (true);
    const auto made = openDevice (plain, {}, forbidden, profiles());
    CHECK_FALSE (made.device);
    CHECK (idOf (made.messages) == "hid/not_permitted");
    CHECK (made.messages.front().remedy.find ("KERNEL==\"hidraw*\", ATTRS{idVendor}==\"1209\", ATTRS{idProduct}==\"0001\", TAG+=\"uaccess\"")
           != std::string::npos);
}

TEST_CASE ("a description is checked without the device, and without HID support only simulated devices open", "[hid]")
{
    CHECK (checkDevice ({ { "driver", "hid" }, { "profile", "board" } }, {}, profiles()).empty());
    CHECK (idOf (checkDevice ({ { "driver", "hid" }, { "profile", "brd" } }, {}, profiles())) == "hid/unknown_profile");
    CHECK (idOf (checkDevice ({ { "driver", "hid" }, { "guard", { { "max_force", "1 mm" } } } }, {}, profiles())) == "device/unit");
    CHECK (checkDevice ({ { "driver", "sim" } }, {}, profiles()).empty());
    CHECK (idOf (makeDevice ({ { "driver", "hid" } }, {}).messages) == "device/real");
    FakeBoard there;
    CHECK (openDevice ({ { "driver", "sim" } }, {}, there, profiles()).device);
}
