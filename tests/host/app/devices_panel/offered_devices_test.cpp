// SPDX-License-Identifier: GPL-3.0-or-later
// Devices that are not found by their HID ids: those at serial ports, those of other drivers, and those that have an address.
#include "host/app/support/canvas_rig.hpp"

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/devices_panel/devices_panel.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
std::vector<OfferedDevice> listed (const hid::LoadedProfiles& profiles)
{
    const std::vector<hid::SerialPort> ports {
        { .path = "/dev/ttyACM0", .product = "Board", .vid = "16c0", .pid = "0486" },
        { .path = "/dev/ttyS0", .may_open = false },
        { .path = "/dev/ttyUSB3", .vid = "0403", .pid = "cb48" },
    };
    auto all = devicesAt (ports, profiles);
    all.push_back ({ "Later arm", { { "driver", "later" }, { "port", "7" } } });   // of a driver that the window does not know
    return all;
}

/// The answers of drivers that are asked.
std::vector<OfferedDevice> foundByDrivers (Messages& messages)
{
    messages.push_back (Message::error ("device/cannot_find", "", "the driver 'old' cannot look for devices", "name the device yourself"));
    return { { "omega.3, number 0", { { "driver", "forcedimension" }, { "port", "sn=10234" } } }, { "Portless", { { "driver", "later" } } } };
}

struct Rig
{
    Rig()
    {
        setup.open (home.path());
        run.use (setup);
        panel.bindings().onHint = [this] (const juce::String& text) { hint = text; };
        panel.setSize (1000, 300);
        panel.setVisible (true);
    }

    std::vector<std::string> labels() { return panel.bindings().choices().front().second; }
    bool offers (const std::string& label) { return std::ranges::count (labels(), label) == 1; }

    Json bound() const
    {
        const auto* now = setup.session().session.binding ("stylus");
        return now != nullptr ? *now : Json();
    }

    TemporaryFolder home;
    DeviceSetup setup { hid::thisComputer(), deviceProfiles(), [] { return std::vector<ConnectedEvents> {}; }, listed, foundByDrivers };
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun run { rig.document, catalogue() };
    DevicesPanel panel { rig.document, run, setup };
    juce::String hint;
};

Json serial (const char* profile, const char* port) { return { { "driver", "serial" }, { "profile", profile }, { "port", port } }; }
}   // namespace

TEST_CASE ("devices at serial ports, and those of drivers that the window does not know, are chosen like all others", "[app][sessions]")
{
    Rig r;
    REQUIRE (tactus::test::eventually ([&] { return r.offers ("Later arm at 7"); }));   // the scan has found them
    const auto board = hid::profileNamed (deviceProfiles(), "tactus_board")->name;
    CHECK (r.offers (board + " at /dev/ttyACM0"));
    CHECK (r.offers ("/dev/ttyS0 as " + board + " (this user may not open it)"));   // nothing says what is there
    CHECK (r.offers ("a Novint Falcon at /dev/ttyUSB3"));
    CHECK (std::ranges::count_if (r.labels(), [] (const auto& l) { return l.ends_with (" at /dev/ttyACM0"); }) == 1);
    CHECK (std::ranges::count_if (r.labels(), [] (const auto& l) { return l.starts_with ("/dev/ttyS0 as "); }) == 3);

    r.panel.bindings().bind ("stylus", board + " at /dev/ttyACM0");
    CHECK (r.bound() == serial ("tactus_board", "/dev/ttyACM0"));
    r.panel.bindings().bind ("stylus", "Later arm at 7");
    CHECK (r.bound() == Json { { "driver", "later" }, { "port", "7" } });
    CHECK_FALSE (r.run.isRunning());   // a choice starts nothing
}

TEST_CASE ("the devices that drivers find are offered once a person asks for them, and a driver that cannot look says so", "[app][sessions]")
{
    Rig r;
    REQUIRE (tactus::test::eventually ([&] { return r.offers ("Later arm at 7"); }));
    CHECK_FALSE (r.offers ("omega.3, number 0 at sn=10234"));
    r.setup.askDrivers();
    REQUIRE (tactus::test::eventually ([&] { return r.offers ("omega.3, number 0 at sn=10234"); }));
    CHECK (r.offers ("Portless at later"));
    CHECK (r.offers ("Later arm at 7"));
    CHECK (r.hint.contains ("'old' cannot look"));
    r.panel.bindings().bind ("stylus", "omega.3, number 0 at sn=10234");
    CHECK (r.bound() == Json { { "driver", "forcedimension" }, { "port", "sn=10234" } });
}

TEST_CASE ("a device is added by its address, and a wrong address is refused and says why", "[app][sessions]")
{
    Rig r;
    r.panel.bindings().bindAddress ("stylus", " udp:tactus_board@192.168.4.1:9750 ");
    CHECK (r.bound() == Json { { "driver", "udp" }, { "profile", "tactus_board" }, { "port", "192.168.4.1:9750" } });
    r.panel.bindings().bindAddress ("stylus", "serial:tactus_board@/dev/ttyACM7");
    CHECK (r.bound() == serial ("tactus_board", "/dev/ttyACM7"));
    CHECK (r.hint.isEmpty());
    r.rig.document.undo();
    CHECK (r.bound()["driver"] == Json ("udp"));

    const auto [address, part] = GENERATE (table<std::string, std::string> ({
        { "udp:tactus_board", "both the profile and the place" },
        { "udp:tactus_board@192.168.4.1", "192.168.4.1" },
        { "serial:tactus_board@ttyACM0", "/dev/ttyACM0" },
        { "serial:no_such_board@/dev/ttyACM0", "no_such_board" },
        { "nosuch:localhost:1", "there is no driver 'nosuch'" },
        { "my arm", "'my arm' is not the address of a device" },
        { "sim", "not the address of a real device" },
        { "/folder/device.json", "not the address of a device" },
        { "a=b", "not the address of a device" },
    }));
    const auto before = r.home.textOf ("session.json");
    r.panel.bindings().bindAddress ("stylus", address);
    INFO (r.hint);
    CHECK (r.hint.contains (part));
    CHECK_FALSE (r.hint.contains ("--"));   // the window has no options
    CHECK_FALSE (r.hint.startsWith (":"));
    CHECK (r.home.textOf ("session.json") == before);
    CHECK (r.panel.bindings().refusedAddress ("stylus") == juce::String (address));
    r.panel.bindings().bind ("stylus", "simulated tool");
    CHECK (r.panel.bindings().refusedAddress ("stylus").isEmpty());
}
