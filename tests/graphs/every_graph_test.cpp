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
#include <tactus/check/trials/trials.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

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

/// A preset, its gesture, and the demands on its devices at several points of the gesture.
struct Measured
{
    check::Subject subject;
    check::HandMotion motion;
    check::Demand demand;
};

Measured measured (const graph::Graph& g, check::Thoroughness thoroughness)
{
    static host::FileAssets assets;
    check::Subject subject { g, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } } };
    auto motion = check::recordMotion (subject, {}, folder).motion;
    auto demand = check::measure (subject, motion, thoroughness);
    return { std::move (subject), std::move (motion), std::move (demand) };
}

/// The conditions that are broken on these devices, separated by commas.
std::string brokenOn (const std::vector<check::RoleDevice>& devices, const check::Demand& demand, const check::Trials* trials = nullptr)
{
    std::string broken;
    for (const auto& c : check::judge (demand, devices, { .trials = trials }))
        if (c.isBroken() && broken.find (c.id) == broken.npos) broken += (broken.empty() ? "" : ", ") + std::string (c.id);
    return broken;
}

/// The same on the simulated devices that the preset describes. Trials decide where the slopes alone break a condition; where they do not,
/// checked_presets_test.cpp makes the trials.
std::string brokenOnItsOwn (const graph::Graph& g, const Measured& m)
{
    std::vector<check::RoleDevice> own;
    for (const auto& [role, description] : g.devices)
        own.push_back ({ role, check::numbersOf (description, folder).value_or (DeviceNumbers {}), "sim", check::simulationOf (description, folder) });
    auto broken = brokenOn (own, m.demand);
    if (broken.empty()) return broken;
    const auto trials = check::tryLoops (m.subject, m.motion, m.demand, own);
    return brokenOn (own, m.demand, &trials);
}

/// The devices on which a preset is checked, each with the conditions of docs/check.md that the preset breaks there: the simulated
/// device that the preset describes, and the devices of the profiles that give a damping. Without a damping, `stiffness` cannot be
/// judged.
std::string devicesFor (const graph::Graph& g, const host::hid::LoadedProfiles& profiles)
{
    const auto all = measured (g, { .places = 32 });
    std::string names;
    const auto add = [&] (const std::string& name, const std::string& broken) {
        names += (names.empty() ? "" : "; ") + name + ": " + (broken.empty() ? "fine" : broken);
    };
    add ("its own", brokenOnItsOwn (g, all));
    for (const auto& profile : profiles.profiles)
    {
        const auto numbers = host::hid::numbersOf (*profile);
        std::vector<check::RoleDevice> devices;
        for (const auto& [role, description] : g.devices)
            devices.push_back ({ role, numbers });
        if (numbers.damping) add (profile->id, brokenOn (devices, all.demand));
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
                       "own), and, without its trials, on each device whose profile states its damping.\n\n"
                       "The simulated devices have a damping of 0.5 to 3 N s/m, as an arm with dampers has. This is more than most bare arms have: the "
                       "profiles guess 0.1 to 1.5 N s/m. A device needs at least the stiffness of the contact times half a tick, plus the damping of the "
                       "contact, so "
                       "on a bare arm nearly every preset breaks `stiffness`. There, turn down the stiffness and the damping of the preset, and raise "
                       "the rate. On its own device, no preset breaks a condition.\n\n"
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
        const auto link = "[" + g.name + "](" + path.filename().string() + ")", devices = devicesFor (g, profiles);
        const std::string cells[] { link, g.about, controls, needs, devices, tags };
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

TEST_CASE ("every preset can be rendered by the device that it describes", "[graphs]")
{
    for (const auto& path : presets())
    {
        DYNAMIC_SECTION (path.stem().string())
        {
            const auto g = loadGraph (path).graph;
            CHECK (brokenOnItsOwn (g, measured (g, {})) == "");
        }
    }
}

TEST_CASE ("the list of presets is up to date", "[graphs]")
{
    const auto path = folder / "README.md";
    const auto now = readme();
    if (std::getenv ("TACTUS_UPDATE")) std::ofstream (path) << now;
    CHECK (textOf (path) == now);
}
