// SPDX-License-Identifier: MIT
// Checks that apply to every preset. A new preset is checked automatically.

#include "host/cli/program.hpp"
#include "support/sketch.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/sessions/needs.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
const fs::path folder = fs::path (TACTUS_SOURCE_DIR) / "graphs";

std::vector<fs::path> presets()
{
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator (folder))
        if (entry.path().extension() == ".json") all.push_back (entry.path());
    std::ranges::sort (all);
    return all;
}

std::string textOf (const fs::path& path)
{
    std::ostringstream text;
    text << std::ifstream (path).rdbuf();
    return text.str();
}

/// Compiles the graph as `tactus render` does.
Compiled compiled (const graph::Graph& g)
{
    static host::FileAssets assets;
    return compile (g, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
}

/// Presets that break a condition of docs/check.md on the simulated device that they describe: which one, and why the preset stays as
/// it is.
const std::map<std::string, std::pair<std::string, std::string>> breaks {
    { "denim",
      { "stiffness",
        "its noise grows with speed, so at some moments it pushes the tool on, which a loop that is linearised there cannot tell from a lasting push" } },
};

/// What a preset asks of its devices, measured at several points of its gesture.
check::Demand demandOf (const graph::Graph& g, check::Thoroughness thoroughness)
{
    static host::FileAssets assets;
    const check::Subject subject { g, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } } };
    return check::measure (subject, check::recordMotion (subject, {}, folder).motion, thoroughness);
}

/// The numbers of the simulated devices that a preset describes.
std::vector<check::RoleDevice> ownDevices (const graph::Graph& g)
{
    std::vector<check::RoleDevice> own;
    for (const auto& [role, description] : g.devices)
        own.push_back ({ role, check::numbersOf (description, folder).value_or (DeviceNumbers {}) });
    return own;
}

/// The conditions that are broken on these devices, separated by commas.
std::string brokenOn (const std::vector<check::RoleDevice>& devices, const check::Demand& demand)
{
    std::string broken;
    for (const auto& c : check::judge (demand, devices))
        if (c.isBroken() && broken.find (c.id) == broken.npos) broken += (broken.empty() ? "" : ", ") + std::string (c.id);
    return broken;
}

/// The devices on which a preset is checked, each with the conditions of docs/check.md that the preset breaks there: the simulated
/// device that the preset describes, and the devices of the profiles that give a damping. Without a damping, `stiffness` cannot be
/// judged.
std::string devicesFor (const graph::Graph& g, const host::hid::LoadedProfiles& profiles)
{
    const auto demand = demandOf (g, { .places = 32 });
    std::string names;
    const auto tryOn = [&] (const std::string& name, const std::vector<check::RoleDevice>& devices) {
        const auto broken = brokenOn (devices, demand);
        names += (names.empty() ? "" : "; ") + name + ": " + (broken.empty() ? "fine" : broken);
    };
    tryOn ("its own", ownDevices (g));
    for (const auto& profile : profiles.profiles)
    {
        const auto numbers = host::hid::numbersOf (*profile);
        std::vector<check::RoleDevice> devices;
        for (const auto& [role, description] : g.devices)
            devices.push_back ({ role, numbers });
        if (numbers.damping) tryOn (profile->id, devices);
    }
    return names;
}

std::string readme()
{
    const auto profiles = host::hid::loadProfiles (fs::path (TACTUS_SOURCE_DIR) / "host" / "devices" / "profiles");
    std::string text = "# Presets\n\nOpen one in the host, or run `tactus play graphs/NAME.json`. This list is generated from the preset files: "
                       "`TACTUS_UPDATE=1 build/release/bin/tactus_tool_tests \"the list of presets*\"`. "
                       "[Why their guards have these limits](../docs/safety.md#the-limits-of-presets-and-profiles). The column "
                       "`devices` lists the conditions that [`tactus check`](../docs/check.md) finds broken: on the simulated device of the preset (its "
                       "own), and on each device whose profile states its damping.\n\n"
                       "The simulated devices have a damping of 0.5 to 3 N s/m, as an arm with dampers has. This is more than a bare arm has: the two "
                       "profiles guess 0.1 N s/m. A device needs at least the stiffness of the contact times half a tick, plus the damping of the contact, so "
                       "on a bare arm nearly every preset breaks `stiffness`. There, turn down the stiffness and the damping of the preset, and raise "
                       "the rate. On its own device, a preset breaks nothing, with these exceptions:\n\n";
    for (const auto& [preset, why] : breaks)
        text += "- `" + preset + "` breaks `" + why.first + "`: " + why.second + ".\n";
    text += "\n"
            "| preset | what it feels like | controls | needs | devices | tags |\n|---|---|---|---|---|---|\n";
    for (const auto& path : presets())
    {
        const auto g = loadGraph (path).graph;
        std::string controls, tags, needs;
        for (const auto& [role, parts] : host::needsOf (*compiled (g).plan))
            needs += (needs.empty() ? "" : "; ") + role + ": " + host::describe (parts);
        for (const auto& c : g.controls)
            controls += (controls.empty() ? "" : ", ") + c.name;
        for (const auto& t : g.tags)
            tags += (tags.empty() ? "" : ", ") + t;
        const std::string cells[] { "[" + g.name + "](" + path.filename().string() + ")", g.about, controls, needs, devicesFor (g, profiles), tags };
        for (const auto& cell : cells)
            text += "| " + cell + " ";
        text += "|\n";
    }
    return text;
}
}   // namespace

TEST_CASE ("every preset passes `tactus check-preset`", "[graphs][check_preset]")
{
    REQUIRE (presets().size() >= 40);
    std::vector<std::string> arguments { "check-preset" };
    for (const auto& path : presets())
    {
        if (std::getenv ("TACTUS_UPDATE")) CHECK (saveGraph (loadGraph (path).graph, path));
        arguments.push_back (path.string());
    }
    const auto ran = test::runTactus (arguments);
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    for (const auto& path : presets())
        CHECK (ran.out.find (path.string() + ": ok\n") != std::string::npos);
}

TEST_CASE ("every preset can be rendered by the device that it describes, or is listed with the condition that it breaks", "[graphs]")
{
    for (const auto& path : presets())
    {
        DYNAMIC_SECTION (path.stem().string())
        {
            const auto g = loadGraph (path).graph;
            const auto listed = breaks.find (path.stem().string());
            CHECK (brokenOn (ownDevices (g), demandOf (g, {})) == (listed == breaks.end() ? "" : listed->second.first));
        }
    }
    for (const auto& [preset, why] : breaks)
        CHECK (fs::exists (folder / (preset + ".json")));
}

TEST_CASE ("the list of presets is up to date", "[graphs]")
{
    const auto path = folder / "README.md";
    const auto now = readme();
    if (std::getenv ("TACTUS_UPDATE")) std::ofstream (path) << now;
    CHECK (textOf (path) == now);
}
