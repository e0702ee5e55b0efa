// SPDX-License-Identifier: MIT
// Serial ports are listed from the files of the system, and nothing is opened.

#include "support/temporary_folder.hpp"

#include <host/devices/hid/usb_adapter.hpp>
#include <host/devices/hid_link/driver_ports.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/devices/hid_link/serial_ports.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

using namespace tactus::host::hid;
namespace fs = std::filesystem;

TEST_CASE ("serial ports are listed with the USB device behind them, and interfaces without hardware are not", "[wires][hid]")
{
    const TemporaryFolder folder;
    const auto classes = folder / "class", usb = folder / "devices/usb1/1-2", files = folder / "dev";
    fs::create_directories (classes);
    fs::create_directories (files / "serial/by-id");
    fs::create_directories (usb / "1-2:1.0/tty");
    folder.write ("devices/usb1/1-2/idVendor", "16c0\n");
    folder.write ("devices/usb1/1-2/idProduct", "0483\n");
    folder.write ("devices/usb1/1-2/product", "USB Serial\n");
    const auto port = [&] (const std::string& name, const std::string& type, const fs::path& device) {
        fs::create_directories (classes / name);
        if (! device.empty()) fs::create_directory_symlink (device, classes / name / "device");
        if (! type.empty()) folder.write ("class/" + name + "/type", type);
        folder.write ("dev/" + name, "");
    };
    fs::create_directories (folder / "devices/pnp");
    port ("ttyACM0", "", usb / "1-2:1.0");
    port ("ttyS0", "4\n", folder / "devices/pnp");
    port ("ttyS1", "0\n", folder / "devices/pnp");
    port ("tty7", "", {});
    port ("ttyUSB0", "", folder / "devices/pnp");
    fs::remove (files / "ttyUSB0");   // its file is not there yet
    fs::create_symlink (files / "ttyACM0", files / "serial/by-id/usb-Teensy-if00");

    const auto ports = serialPorts (classes, files);
    REQUIRE (ports.size() == 2);
    CHECK (ports[0].path == (files / "serial/by-id/usb-Teensy-if00").string());
    CHECK (ports[0].vid == "16c0");
    CHECK (ports[0].pid == "0483");
    CHECK (ports[0].product == "USB Serial");
    CHECK (ports[0].may_open);
    CHECK (ports[1].path == (files / "ttyS0").string());
    CHECK (ports[1].vid.empty());

    CHECK (serialPorts (folder / "nothing", files).empty());
}

TEST_CASE ("a serial port could have a device of each profile that names a serial line, and first of all the one with its USB ids", "[wires][hid]")
{
    const auto shipped = loadProfiles (profileFolder());
    const auto idsFor = [&] (const SerialPort& port) {
        std::vector<std::string> ids;
        for (const auto& profile : profilesFor (port, shipped.profiles))
            ids.push_back (profile->id);
        return ids;
    };
    const auto of_unknown = idsFor ({ .path = "/dev/ttyS0" });
    CHECK (of_unknown == std::vector<std::string> { "dualpanto", "haply_2diy", "tactus_board" });
    CHECK (idsFor ({ .path = "/dev/ttyACM0", .vid = "1234", .pid = "0006" }) == of_unknown);
    const auto of_board = idsFor ({ .path = "/dev/ttyACM0", .vid = "16c0", .pid = "0486" });
    CHECK (of_board == std::vector<std::string> { "tactus_board", "dualpanto", "haply_2diy" });
    CHECK (profilesFor ({ .path = "/dev/ttyS0" }, {}).empty());
}

TEST_CASE ("the port of a Falcon names its driver, and what makes it slow or hides it is told with the remedy", "[wires][falcon]")
{
    const TemporaryFolder folder;
    folder.write ("ttyUSB3", "");
    const SerialPort falcon { .path = (folder / "ttyUSB3").string(), .vid = "0403", .pid = "cb48" };
    REQUIRE (driverOf (falcon) != nullptr);
    CHECK (driverOf (falcon)->driver == std::string ("falcon"));
    CHECK (driverOf ({ .path = "/dev/ttyUSB0", .vid = "0403", .pid = "6001" }) == nullptr);
    CHECK (driverOf ({ .path = "/dev/ttyS0" }) == nullptr);

    const auto adapters = folder / "adapters";
    CHECK (slowAdapter (falcon.path, adapters).empty());
    fs::create_directories (adapters / "ttyUSB3");
    folder.write ("adapters/ttyUSB3/latency_timer", "16\n");
    CHECK (slowAdapter (falcon.path, adapters)
           == "its adapter keeps answers for up to 16 ms: sudo sh -c 'echo 1 > " + (adapters / "ttyUSB3/latency_timer").string() + "'");
    folder.write ("adapters/ttyUSB3/latency_timer", "1\n");
    CHECK (slowAdapter (falcon.path, adapters).empty());

    const auto usb = folder / "usb";
    CHECK (withoutPort ({}, usb).empty());
    fs::create_directories (usb / "1-2");
    folder.write ("usb/1-2/idVendor", "0403\n");
    folder.write ("usb/1-2/idProduct", "cb48\n");
    CHECK (withoutPort ({}, usb).find ("echo 0403 cb48 > /sys/bus/usb-serial/drivers/ftdi_sio/new_id") != std::string::npos);
    CHECK (withoutPort ({}, usb).find ("or, with libftdi: --device ROLE=falcon:usb") != std::string::npos);
    CHECK (withoutPort (std::vector { falcon }, usb).empty());

    REQUIRE (deviceOf ("falcon") != nullptr);
    CHECK (deviceOf ("haply") == nullptr);
    CHECK (portsOf (*deviceOf ("falcon"), std::vector { falcon, SerialPort { .path = "/dev/ttyS0" } }, usb) == std::vector { falcon.path });
    CHECK (portsOf (*deviceOf ("falcon"), {}, usb) == std::vector<std::string> { "usb" });
    CHECK (portsOf (*deviceOf ("falcon"), {}, folder / "none").empty());
}
