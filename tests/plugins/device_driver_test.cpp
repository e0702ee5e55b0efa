// SPDX-License-Identifier: MIT
// Drivers of devices in plugins: which file is loaded, when, and for whom.
#include "load.hpp"
#include "support/other_user.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/live/hardware.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <host/devices/sessions/role_fits.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include <sys/wait.h>
#include <unistd.h>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
/// The folders of plugins and of this user, while it exists.
class Installed
{
public:
    explicit Installed (const fs::path& plugins = test::driverFolder())
    {
        set ("TACTUS_PLUGINS", plugins.string());
        set ("TACTUS_HOME", (home / "tactus").string());
    }
    ~Installed()
    {
        for (const auto& [name, value] : before)
            if (value)
                ::setenv (name.c_str(), value->c_str(), 1);
            else
                ::unsetenv (name.c_str());
    }

private:
    void set (const char* name, const std::string& value)
    {
        const char* now = std::getenv (name);
        before.emplace_back (name, now != nullptr ? std::optional<std::string> (now) : std::nullopt);
        ::setenv (name, value.c_str(), 1);
    }

    TemporaryFolder home;
    std::vector<std::pair<std::string, std::optional<std::string>>> before;
};

std::string idOf (const Messages& messages)
{
    const auto at = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    return at == messages.end() ? std::string() : at->id;
}

const host::hid::LoadedProfiles no_profiles;
}   // namespace

TEST_CASE ("a driver is found by the name of its file, and only under names that are no paths and none of Tactus", "[plugins]")
{
    const TemporaryFolder first, second;
    for (const auto* folder : { &first, &second })
        fs::copy_file (test::driverFile ("lying"), *folder / "lying.tactus-device");
    fs::copy_file (test::driverFile ("lying"), first / "hid.tactus-device");
    fs::create_directory (first / "folder.tactus-device");
    const std::vector<fs::path> folders { "/nowhere", first.path(), second.path() };
    CHECK (host::findDriver ("lying", folders) == first / "lying.tactus-device");
    CHECK (host::findDriver ("lying", { second.path() }) == second / "lying.tactus-device");
    for (const char* name : { "hid", "folder", "other", "../lying", "Lying", "", "lying.tactus-device", "sim" })
    {
        CAPTURE (name);
        CHECK_FALSE (host::findDriver (name, folders));
    }
}

TEST_CASE ("a driver that is broken, or for another version, is refused", "[plugins]")
{
    const auto idFor = [] (const std::string& name) {
        const auto driver = host::DeviceDriver::load (test::driverFile (name));
        return driver ? std::string() : driver.error().id;
    };
    CHECK (idFor ("lying") == "");
    CHECK (idFor ("bad_abi") == "plugin/wrong_abi");
    CHECK (idFor ("bad_size") == "plugin/wrong_size");
    CHECK (idFor ("bad_no_entry") == "plugin/no_entry");
    CHECK (idFor ("bad_rest") == "plugin/bad_driver");
    CHECK (idFor ("bad_key") == "plugin/bad_driver");
    CHECK (idFor ("misnamed") == "plugin/bad_driver");
    CHECK (idFor ("does_not_exist") == "plugin/cannot_load");
    CHECK (host::DeviceDriver::load (test::pluginFile ("in_c")).error().id == "plugin/no_entry");   // a node plugin
    CHECK (loadPlugins ({ test::driverFile ("lying") }, {}).messages[0].id == "plugin/no_entry");
}

TEST_CASE ("a driver that another user could have written is not loaded", "[plugins][safety]")
{
    const TemporaryFolder folder;
    const auto file = folder / "lying.tactus-device";
    fs::copy_file (test::driverFile ("lying"), file);
    fs::permissions (file, fs::perms::others_write, fs::perm_options::add);
    CHECK (host::DeviceDriver::load (file).error().id == "plugin/foreign");
    fs::permissions (file, fs::perms::others_write, fs::perm_options::remove);
    if (! test::giveAway (file)) return;
    CHECK (host::DeviceDriver::load (file).error().id == "plugin/foreign");
}

TEST_CASE ("a driver that ends the program while it is loaded is not loaded again until it changes", "[plugins][safety]")
{
    const TemporaryFolder folder;
    const Installed installed (folder.path());
    const auto file = folder / "lying.tactus-device";
    fs::copy_file (test::pluginFile ("crashing"), file);
    const Json description { { "driver", "lying" }, { "port", "honest" } };
    const auto child = ::fork();
    if (child == 0)
    {
        host::openPluginDevice (description);
        ::_exit (0);
    }
    int status = -1;
    REQUIRE (::waitpid (child, &status, 0) == child);
    CHECK (WEXITSTATUS (status) == 77);
    CHECK (idOf (host::openPluginDevice (description).messages) == "plugin/quarantined");

    fs::copy_file (test::driverFile ("lying"), file, fs::copy_options::overwrite_existing);
    fs::last_write_time (file, fs::file_time_type::clock::now() + std::chrono::seconds (1));
    CHECK (host::openPluginDevice (description).device);
}

TEST_CASE ("the option --device names a driver and its port", "[plugins]")
{
    const Installed installed;
    Messages notes;
    const auto parse = [&] (const std::string& text) {
        return host::parseDeviceOption (
            text, {}, {}, [&]() -> const host::hid::LoadedProfiles& { return no_profiles; }, notes);
    };
    const auto option = parse ("stylus=serial_arm:/dev/ttyACM0");
    REQUIRE (option);
    CHECK (option->role == "stylus");
    CHECK (option->description == Json { { "driver", "serial_arm" }, { "port", "/dev/ttyACM0" } });
    CHECK (parse ("stylus=serial_arm")->description == Json { { "driver", "serial_arm" } });
    CHECK (parse ("stylus=lying:a:b")->description == Json { { "driver", "lying" }, { "port", "a:b" } });
    for (const char* text : { "stylus=serial_leg:/dev/ttyACM0", "stylus=../serial_arm:x", "Stylus=serial_arm:x", "stylus=:x" })
    {
        CAPTURE (text);
        REQUIRE_FALSE (parse (text));
        CHECK (parse (text).error().id == "device/option");
        CHECK (parse (text).error().remedy.find ("ROLE=DRIVER:PORT") != std::string::npos);
    }
    CHECK (parse ("stylus=serial_leg:/dev/ttyACM0").error().remedy.find ("serial_leg.tactus-device") != std::string::npos);
}

TEST_CASE ("a device of a driver is opened for a person, and for nobody without hardware", "[plugins][safety]")
{
    const Installed installed;
    const auto compiled = test::Sketch {}.node ("hand", "device.position").compile();
    const auto& plan = *compiled.plan;
    const Json description { { "driver", "lying" }, { "port", "honest" } };
    host::Hardware none;
    CHECK (idOf (none.open (description, {}, "stylus", plan).messages) == "device/real");   // `tactus render`
    host::Hardware hardware { host::hid::thisComputer(), []() -> const host::hid::LoadedProfiles& { return no_profiles; }, nullptr };
    const auto made = hardware.open (description, {}, "stylus", plan);
    REQUIRE (made.device);
    CHECK (made.limits.max_force == 2.0);
    CHECK (made.about == "A device that is not there.");
    CHECK (idOf (hardware.open ({ { "driver", "lying" }, { "prot", "a" } }, {}, "stylus", plan).messages) == "device/unknown_key");
    CHECK (idOf (hardware.open ({ { "driver", "nobody" } }, {}, "stylus", plan).messages) == "device/unknown_driver");

    CHECK (host::checkDescription (description, {}, no_profiles).empty());   // for `tactus session --bind`
    CHECK (idOf (host::checkDescription ({ { "driver", "lying" }, { "port", "100%" } }, {}, no_profiles)) == "device/refused");
    CHECK (host::nameOf (description) == "lying honest");
}

TEST_CASE ("the open Devices panel loads no driver, however often it looks", "[plugins][safety]")
{
    const TemporaryFolder folder;
    const Installed installed (folder.path());
    fs::copy_file (test::pluginFile ("crashing"), folder / "lying.tactus-device");   // ends the program if it is loaded
    host::LoadedSession session;
    session.session.bind ("stylus", { { "driver", "lying" }, { "port", "honest" }, { "guard", { { "max_force", "1 N" } } } });
    session.session.bind ("thumb", { { "driver", "nobody" } });
    const auto fits = host::fitsOf ({ { "stylus", {} }, { "thumb", {} } }, {}, session, no_profiles, {});
    REQUIRE (fits.size() == 2);
    CHECK (fits[0].from == host::RoleFit::From::session);
    CHECK (fits[0].messages.empty());
    CHECK (idOf (fits[1].messages) == "device/unknown_driver");
    CHECK (fits[1].messages[0].remedy.find ("nobody.tactus-device, must be in a folder of plugins") != std::string::npos);
    CHECK (host::namesPlugin (fits[0].description));
    CHECK (host::namesPlugin (fits[1].description));
    for (const char* driver : { "sim", "trace", "gesture", "hid", "audio", "" })
        CHECK_FALSE (host::namesPlugin ({ { "driver", driver } }));
}

TEST_CASE ("the id of a profile that holds only numbers means the profile, also if there is a driver of that name", "[plugins][safety]")
{
    const TemporaryFolder folder;
    const Installed installed (folder.path());
    fs::copy_file (test::driverFile ("lying"), folder / "phantom_1_0.tactus-device");
    const auto profiles = host::hid::loadProfiles (fs::path (TACTUS_SOURCE_DIR) / "host" / "devices" / "profiles");
    Messages notes;
    const auto driverOf = [&] (const std::string& text) {
        const auto option = host::parseDeviceOption (
            text, {}, {}, [&]() -> const host::hid::LoadedProfiles& { return profiles; }, notes);
        REQUIRE (option);
        return option->description["driver"].get<std::string>();
    };
    CHECK (driverOf ("stylus=phantom_1_0") == "sim");
    REQUIRE (notes.size() == 1);
    CHECK (notes[0].id == "device/numbers_only");
    CHECK (driverOf ("stylus=phantom_1_0:/dev/ttyACM0") == "phantom_1_0");
}

TEST_CASE ("a graph never chooses a driver: none is opened, nor even loaded, for what it describes", "[plugins][safety]")
{
    const TemporaryFolder folder;
    const Installed installed (folder.path());
    fs::copy_file (test::pluginFile ("crashing"), folder / "lying.tactus-device");   // ends the program if it is loaded
    const Json description { { "driver", "lying" }, { "port", "honest" } };
    CHECK (host::isPluginDevice (description));
    CHECK_FALSE (isSimulated (description));
    Messages messages;
    const auto used = describedByGraph (&description, "stylus", messages);
    CHECK_FALSE (makeDevice (used, {}).device);
    CHECK (idOf (makeDevice (used, {}).messages) == "device/unknown_driver");

    graph::Graph graph;
    graph.devices.emplace_back ("stylus", description);
    const auto fits = host::fitsOf ({ { "stylus", {} } }, graph, {}, no_profiles, {});
    REQUIRE (fits.size() == 1);
    CHECK (idOf (fits[0].messages) == "device/unknown_driver");
}
