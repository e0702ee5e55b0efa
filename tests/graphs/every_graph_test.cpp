// SPDX-License-Identifier: MIT
// Checks that apply to every preset. A new preset is checked automatically.

#include "support/sketch.hpp"

#include <host/assets/file_assets.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/hid/physics.hpp>
#include <host/hid/profile_reader.hpp>
#include <host/sessions/needs.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
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
Compiled compiled (const graph::Graph& g, std::vector<plan::Override> overrides = {})
{
    static host::FileAssets assets;
    return compile (g, catalogue(), { .overrides = std::move (overrides), .assets = &assets, .services = { .nearest_triangle = host::nearestByEmbree } });
}

struct Run
{
    std::vector<double> forces;   // on the tools: all components, tick after tick
    double largest = 0.0, last = 0.0;
    bool stopped = false;
};

/// The limits that a tool in play should stay far below, made smaller.
GuardLimits partOf (GuardLimits limits, double share)
{
    for (auto* limit : { &limits.max_speed, &limits.max_impulse, &limits.max_energy })
        *limit *= share;
    return limits;
}

Run run (const graph::Graph& g, const std::vector<plan::Override>& overrides = {}, double share_of_limits = 1.0)
{
    auto [plan, messages] = compiled (g, overrides);
    INFO (test::text (messages));
    REQUIRE (plan);
    Engine engine { plan };

    std::vector<MadeDevice> devices;
    double duration = 0.0;
    for (const auto& role : engine.plan().roles())
    {
        const auto described = std::ranges::find (g.devices, role.name, &std::pair<std::string, Json>::first);
        REQUIRE (described != g.devices.end());
        devices.push_back (makeDevice (described->second, folder));
        INFO (test::text (devices.back().messages));
        REQUIRE (devices.back().device);
        duration = std::max (duration, devices.back().device->duration());
    }
    for (std::size_t i = 0; i < devices.size(); ++i)
        engine.attach (engine.plan().roles()[i].name, *devices[i].device, partOf (devices[i].limits, share_of_limits));
    REQUIRE (duration > 0.0);

    Run result;
    for (int k = 0; k < static_cast<int> (duration * g.rate_hz); ++k)
    {
        engine.tick();
        result.last = 0.0;
        for (const auto& role : engine.plan().roles())
        {
            const auto& f = role.state->applied.force;
            result.forces.insert (result.forces.end(), f.data(), f.data() + 3);
            result.last = std::max (result.last, f.norm());
            result.stopped = result.stopped || engine.guardOf (role.name).stop() != Guard::Stop::none;
        }
        result.largest = std::max (result.largest, result.last);
    }
    return result;
}

/// Presets that break a condition of docs/check.md on the simulated device that they describe: which one, and why the preset stays as
/// it is.
const std::map<std::string, std::pair<std::string, std::string>> breaks {
    { "braked_wall", { "stiffness", "it needs the brake of its device, which `tactus check` does not count" } },
    { "denim",
      { "stiffness",
        "its noise grows with speed, so at some moments it pushes the tool on, which a loop that is linearised there cannot tell from a lasting push" } },
};

/// What a preset asks of its devices, measured at several points of its gesture.
check::Demand demandOf (const graph::Graph& g, check::Thoroughness thoroughness)
{
    static host::FileAssets assets;
    const check::Subject subject { g, catalogue(), { .assets = &assets, .services = { .nearest_triangle = host::nearestByEmbree } } };
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
    const auto profiles = host::hid::loadProfiles (fs::path (TACTUS_SOURCE_DIR) / "host" / "profiles");
    std::string text = "# Presets\n\nOpen one in the host, or run `tactus play graphs/NAME.json`. This list is generated from the preset files: "
                       "`TACTUS_UPDATE=1 build/release/bin/tactus_tests \"the list of presets*\"`. "
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

TEST_CASE ("every preset is formatted as Tactus saves it, says what it feels like, and compiles without warnings", "[graphs]")
{
    REQUIRE (presets().size() >= 4);
    for (const auto& path : presets())
    {
        DYNAMIC_SECTION (path.stem().string())
        {
            const auto loaded = loadGraph (path);
            INFO (test::text (loaded.messages));
            CHECK (loaded.messages.empty());
            CHECK (loaded.graph.name.size() > 3);
            CHECK (loaded.graph.about.size() > 30);
            CHECK_FALSE (loaded.graph.tags.empty());
            if (std::getenv ("TACTUS_UPDATE")) CHECK (saveGraph (loaded.graph, path));
            CHECK (writeGraph (loaded.graph) == textOf (path));

            const auto messages = compiled (loaded.graph).messages;
            INFO (test::text (messages));
            CHECK (messages.empty());
        }
    }
}

TEST_CASE ("every preset says where the numbers of its materials come from, and marks guesses as guesses", "[graphs]")
{
    const std::set<std::string> materials { "friction", "cut", "deform", "field", "texture", "vibration", "shock" };
    for (const auto& path : presets())
    {
        DYNAMIC_SECTION (path.stem().string())
        {
            const auto g = loadGraph (path).graph;
            const auto sources = g.extra.value ("ui", Json::object()).value ("sources", Json::object());
            for (const auto& node : g.root.nodes)
            {
                if (! materials.contains (node.type.substr (0, node.type.find ('.'))) || node.type == "texture.antialias") continue;
                INFO (node.name);
                CHECK (std::ranges::any_of (sources.items(), [&] (const auto& entry) { return entry.first.starts_with (node.name + "."); }));
            }
            for (const auto& [name, source] : sources.items())
            {
                INFO (name);
                REQUIRE (source.is_string());
                CHECK (source.get<std::string>().size() >= 5);
                const auto node = name.substr (0, name.find_first_of ("./"));
                CHECK (std::ranges::any_of (g.root.nodes, [&] (const graph::Node& n) { return n.name == node; }));
            }
        }
    }
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

TEST_CASE ("every preset responds to the hand on the same tick", "[graphs]")
{
    for (const auto& path : presets())
    {
        DYNAMIC_SECTION (path.stem().string())
        {
            const auto plan = compiled (loadGraph (path).graph).plan;
            REQUIRE (plan);
            REQUIRE_FALSE (plan->delays().empty());
            for (const auto& d : plan->delays())
                CHECK (d.shortest == 0);
        }
    }
}

TEST_CASE ("every preset produces a force, stays within its guard, ends at zero, and repeats bit for bit", "[graphs]")
{
    for (const auto& path : presets())
    {
        DYNAMIC_SECTION (path.stem().string())
        {
            const auto g = loadGraph (path).graph;
            const auto first = run (g);
            CHECK (first.largest > 0.05);
            CHECK (first.largest < 10.0);
            CHECK (first.last < 0.05);
            CHECK_FALSE (first.stopped);
            for (const double f : first.forces)
                REQUIRE (std::isfinite (f));
            CHECK (run (g).forces == first.forces);
        }
    }
}

TEST_CASE ("the guard of every preset limits force, speed, impulse and energy, and its own gesture needs at most half of the last three", "[graphs]")
{
    for (const auto& path : presets())
    {
        DYNAMIC_SECTION (path.stem().string())
        {
            const auto g = loadGraph (path).graph;
            for (const auto& [role, description] : g.devices)
            {
                INFO (role);
                const auto limits = makeDevice (description, folder).limits;
                for (const double limit : { limits.max_force, limits.max_speed, limits.max_impulse, limits.max_energy })
                    CHECK (limit != GuardLimits::none);
            }
            CHECK_FALSE (run (g, {}, 0.5).stopped);
        }
    }
}

TEST_CASE ("every control of every preset can be set to both ends and changes the force", "[graphs]")
{
    for (const auto& path : presets())
    {
        const auto g = loadGraph (path).graph;
        CHECK_FALSE (g.controls.empty());
        for (const auto& c : g.controls)
        {
            DYNAMIC_SECTION (path.stem().string() << ": " << c.id)
            {
                const auto low = run (g, { { c.id, 0.0 } }), high = run (g, { { c.id, 1.0 } });
                CHECK (low.forces != high.forces);
                CHECK_FALSE (low.stopped);
                CHECK_FALSE (high.stopped);
                CHECK (high.largest < 10.0);
            }
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
