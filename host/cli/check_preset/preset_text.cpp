// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_text.hpp"

#include <tactus/run/device/make_device.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <system_error>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

// A preset comes with Tactus, so everybody may pass it on and change it.
constexpr std::string_view licences[] { "0BSD", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "CC-BY-4.0", "CC-BY-SA-4.0",
                                        "CC0-1.0", "GPL-3.0-only", "GPL-3.0-or-later", "ISC", "MIT", "Zlib" };

constexpr std::string_view materials[] { "friction", "cut", "deform", "field", "texture", "vibration", "shock" };   // families with numbers of a material

// docs/safety.md, "The limits of presets and profiles".
constexpr double most_force = 10.0, most_speed = 2.0, impulse_per_force = 5.0, impulse_window = 10.0, energy_per_force = 0.02, energy_window = 1.0;

constexpr double lowest_rate = 1000.0, highest_rate = 20'000.0;
constexpr std::size_t most_controls = 16;

Message wrong (const char* id, std::string where, std::string text, std::string remedy)
{
    return Message::error (std::string ("preset/") + id, std::move (where), std::move (text), std::move (remedy));
}

void examineWords (const graph::Graph& g, Messages& messages)
{
    if (g.name.size() <= 3) messages.push_back (wrong ("name", "/name", "the preset has no name of more than 3 letters", "write \"name\": \"Dry wood\""));
    if (g.about.size() <= 30)
        messages.push_back (
            wrong ("about", "/about", "the preset does not say what it feels like",
                   "write a sentence or two as `about`: what the hand feels, and what to try"));
    if (g.tags.empty())
        messages.push_back (
            wrong ("tags", "/tags", "the preset has no tags",
                   "write some, such as \"tags\": [\"wood\", \"stroke\"]; one of stroke, circle, press, tap and cut names its part of the gallery"));
    if (g.rate_hz < lowest_rate || g.rate_hz > highest_rate)
        messages.push_back (wrong ("rate", "/rate_hz", "the preset ticks at " + numberText (g.rate_hz) + " Hz", "choose a rate from 1000 to 20000 Hz"));
    if (g.controls.empty() || g.controls.size() > most_controls)
        messages.push_back (wrong ("controls", "/controls",
                                   g.controls.empty() ? "the preset has no knob" : "the preset has " + std::to_string (g.controls.size()) + " knobs",
                                   "give it from 1 to 16 `controls`, the first of which changes most of what the hand feels"));
}

void examineLicence (const Json& ui, Messages& messages)
{
    const auto* licence = ui.is_object() && ui.contains ("license") ? &ui.at ("license") : nullptr;
    if (licence != nullptr && licence->is_string() && std::ranges::count (licences, std::string_view (licence->asString())) > 0) return;
    std::string known;
    for (const auto id : licences)
        addToList (known, id);
    const auto given = licence == nullptr     ? std::string ("the preset does not say under which licence it is")
                       : licence->is_string() ? "a preset with the licence " + quote (licence->asString()) + " cannot be shared with Tactus"
                                              : std::string ("the licence is not a text");
    messages.push_back (wrong ("licence", licence == nullptr ? "/ui" : "/ui/license", given,
                               "under `ui`, write \"license\": \"MIT\", or another of these SPDX ids: " + known));
}

bool isMaterial (std::string_view type) { return type != "texture.antialias" && std::ranges::count (materials, type.substr (0, type.find ('.'))) > 0; }

void examineSources (const graph::Graph& g, const Json& ui, Messages& messages)
{
    const Json nothing = Json::object();
    const auto& sources = ui.is_object() && ui.contains ("sources") ? ui.at ("sources") : nothing;
    for (const auto& node : g.root.nodes)
        if (isMaterial (node.type) && std::ranges::none_of (sources.items(), [&] (const auto& entry) { return entry.first.starts_with (node.name + "."); }))
            messages.push_back (wrong ("source", "/nodes/" + pointerPart (node.name), "nothing says where the numbers of " + quote (node.name) + " come from",
                                       "under `ui`, write \"sources\": { \"" + node.name + ".PARAM\": \"a paper, a measurement, or: guess\" }"));
    for (const auto& [name, source] : sources.items())
    {
        const auto where = "/ui/sources/" + pointerPart (name);
        const auto node = std::string_view (name).substr (0, name.find_first_of ("./"));
        if (g.root.find (node) == nullptr)
            messages.push_back (wrong ("source", where, "the source " + quote (name) + " is for a node that does not exist",
                                       "write NODE.PARAM, with the name of a node"));
        if (! source.is_string() || source.asString().size() < 5)
            messages.push_back (wrong ("source", where, "the source of " + quote (name) + " says nothing",
                                       "name the paper or the measurement, or write: guess"));
    }
}

/// A limit that a guard must have, and the largest value that it may have.
struct Needed
{
    const char* key;
    double has, most, window, least_window;
    const char* unit;
};

void examineGuard (const GuardLimits& limits, const std::string& where, Messages& messages)
{
    const double force = std::min (limits.max_force, most_force);
    const Needed all[] { { "max_force", limits.max_force, most_force, 0.0, 0.0, "N" },
                         { "max_speed", limits.max_speed, most_speed, 0.0, 0.0, "m/s" },
                         { "max_impulse", limits.max_impulse, impulse_per_force * force, limits.impulse_window, impulse_window, "N*s" },
                         { "max_energy", limits.max_energy, energy_per_force * force, limits.energy_window, energy_window, "J" } };
    for (const auto& n : all)
    {
        const bool is_short = n.window > 0.0 && n.window < n.least_window;   // a window of 0 is the whole session
        if (n.has <= n.most * (1.0 + 1e-9) && ! is_short) continue;
        const auto most = roundedText (n.most) + " " + n.unit + (n.least_window > 0.0 ? " in " + roundedText (n.least_window) + " s" : "");
        messages.push_back (wrong ("guard", where + "/guard",
                                   n.has == GuardLimits::none ? "the guard has no " + std::string (n.key)
                                                              : "the guard allows more than the guards of presets do: " + std::string (n.key),
                                   "set " + std::string (n.key) + " to at most " + most + "; docs/safety.md says why"));
    }
}

void examineDevices (const graph::Graph& g, const fs::path& folder, Messages& messages)
{
    for (const auto& [role, description] : g.devices)
    {
        const auto where = "/devices/" + pointerPart (role);
        const bool has_driver = description.is_object() && description.contains ("driver") && description.at ("driver").is_string();
        if (! has_driver || description.at ("driver").asString() != "sim" || ! description.contains ("hand"))
        {
            messages.push_back (wrong ("device", where, "the role " + quote (role) + " has no simulated device with a hand",
                                       "describe one with \"driver\": \"sim\" and a `hand`, so that everybody can try the preset without a device"));
            continue;
        }
        auto made = makeDevice (description, folder);
        if (made.device) examineGuard (made.limits, where, messages);
        for (auto& m : made.messages)
        {
            m.where = where + m.where;
            messages.push_back (std::move (m));
        }
    }
}

bool isWithin (const fs::path& path, const fs::path& folder)
{
    std::error_code failed;
    const auto whole = fs::weakly_canonical (fs::absolute (path, failed), failed);   // of a name that does not exist, it would stay relative
    if (failed) return false;
    const auto home = fs::weakly_canonical (folder.empty() ? fs::path (".") : folder, failed);
    return ! failed && std::ranges::mismatch (home, whole).in1 == home.end();
}

/// The files that a graph includes, and those that the files include.
void listIncluded (const graph::Graph& g, std::set<std::string>& all)
{
    for (const auto& [path, included] : g.files)
        if (all.insert ((fs::path (g.folder) / path).string()).second && included) listIncluded (*included, all);
}
}   // namespace

Messages examineText (const LoadedGraph& loaded, std::string_view text, const fs::path& folder)
{
    const auto& g = loaded.graph;
    Messages messages;
    if (! hasErrors (loaded.messages) && writeGraph (g) != text)
        messages.push_back (wrong ("format", "", "the file is not formatted as Tactus saves it", "give --format, which saves it in that form"));
    const Json nothing = Json::object();
    const auto& ui = g.extra.contains ("ui") ? g.extra.at ("ui") : nothing;
    examineWords (g, messages);
    examineLicence (ui, messages);
    examineSources (g, ui, messages);
    examineDevices (g, folder, messages);
    return messages;
}

Messages examineParts (const graph::Graph& g, const Plan& plan, const std::set<std::string>& assets, const fs::path& folder)
{
    Messages messages;
    for (const auto& role : plan.roles())
        if (g.device (role.name) == nullptr)
            messages.push_back (wrong ("device", "/devices", "no device is described for the role " + quote (role.name),
                                       "describe one under `devices`, with \"driver\": \"sim\""));
    if (plan.delays().empty() || std::ranges::any_of (plan.delays(), [] (const plan::PathDelay& d) { return d.shortest > 0; }))
        messages.push_back (wrong ("late", "/wires",
                                   plan.delays().empty() ? "no path leads from a hand to a motor" : "the force responds to the hand one or more ticks late",
                                   "lead a wire without a delay from the hand to each motor"));
    auto files = assets;
    listIncluded (g, files);
    for (const auto& [role, description] : g.devices)
        for (const auto* at : { "/path", "/hand/path" })
            if (const JsonPointer path (at); description.contains (path) && description.at (path).is_string())
                files.insert ((folder / description.at (path).asString()).string());
    for (const auto& file : files)
        if (! isWithin (file, folder))
            messages.push_back (wrong ("outside", "", "the preset reads " + quotePath (file) + ", which is not in its folder",
                                       "put the file beside the preset, or in a folder beside it"));
    return messages;
}

}   // namespace tactus::host
