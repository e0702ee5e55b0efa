// SPDX-License-Identifier: MIT
#include <host/devices/hid/physics.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <tactus/run/device/sim.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
using Described = std::vector<std::pair<std::string, Json>>;

const host::hid::LoadedProfiles& shippedProfiles()
{
    static const auto all = host::hid::loadProfiles (std::filesystem::path (TACTUS_SOURCE_DIR) / "host" / "devices" / "profiles");
    return all;
}

Result<DeviceOption> optionOf (std::string_view text, Messages& notes, const Described& described = {})
{
    return host::parseDeviceOption (text, described, {}, shippedProfiles, notes);
}
}   // namespace

TEST_CASE ("a device known by numbers: its profile gives a simulated device with these numbers, in the hand of the graph", "[host][devices]")
{
    const Described described { { "stylus", Json::parse (R"({ "driver": "sim", "mass": "1 kg", "coulomb": 3, "delay": 4, "hand": { "path": "stroke" },
                                                             "guard": { "max_force": "20 N", "ramp": "0.1 s" } })") } };
    Messages notes;
    const auto option = optionOf ("stylus=phantom_1_0", notes, described);
    REQUIRE (option);
    REQUIRE (notes.size() == 1);
    CHECK (notes[0].id == "device/numbers_only");
    CHECK (notes[0].severity == Message::Severity::warning);
    CHECK (notes[0].text.find ("guessed: mass, damping") != std::string::npos);
    CHECK (notes[0].text.find ("first_mode,") == std::string::npos);

    const auto made = makeDevice (option->description, option->folder);
    for (const auto& m : made.messages)
        FAIL_CHECK (m.where + ": " + m.text);
    const auto* device = dynamic_cast<const SimulatedDevice*> (made.device.get());
    REQUIRE (device != nullptr);
    const auto& sim = device->simulation();
    CHECK (sim.mass == 0.075);
    CHECK (sim.coulomb == 0.04);
    CHECK (sim.quantum == 30e-6);
    CHECK (sim.delay == 0);
    CHECK (sim.first_mode == 30.0);
    CHECK (sim.end_mass == 0.0375);
    CHECK (sim.hand.path);
    CHECK (made.limits.max_force == 8.5);
    CHECK (made.limits.ramp == 0.1);
}

TEST_CASE ("a device known by numbers: a profile that lacks a number gives the default, not that of the graph", "[host][devices]")
{
    DeviceNumbers numbers;
    numbers.mass = DeviceNumber { .value = 0.2 };
    numbers.end_mass = DeviceNumber { .value = 0.1 };   // has no effect without a first mode
    numbers.peak_force = DeviceNumber { .value = 30.0 };
    const auto sim = host::withNumbers (Json::parse (R"({ "driver": "sim", "damping": 7, "first_mode": 50, "guard": { "max_force": "20 N" } })"), numbers);
    CHECK (sim == Json::parse (R"({ "driver": "sim", "guard": { "max_force": "20 N" }, "mass": 0.2 })"));
}

TEST_CASE ("a device known by numbers: other options mean what they did, and a real device is not simulated by mistake", "[host][devices]")
{
    Messages notes;
    CHECK (optionOf ("stylus=sim", notes)->description["driver"].get<std::string>() == "sim");
    CHECK (optionOf ("stylus=hid:phantom_1_0", notes)->description["driver"].get<std::string>() == "hid");
    const auto real = optionOf ("stylus=tactus_board", notes);
    REQUIRE_FALSE (real);
    CHECK (real.error().remedy.find ("hid:tactus_board") != std::string::npos);
    const auto unknown = optionOf ("stylus=phantom_9", notes);
    REQUIRE_FALSE (unknown);
    CHECK (unknown.error().id == "device/option");
    CHECK_FALSE (optionOf ("St=phantom_1_0", notes));
    CHECK (notes.empty());
}
