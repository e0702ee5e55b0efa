// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_runs.hpp"
#include "preset_text.hpp"

#include <host/cli/check_each.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/graph_argument.hpp>
#include <host/cli/report.hpp>
#include <host/cli/run_options.hpp>

#include <host/base/assets/file_assets.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/rules/unheard.hpp>
#include <tactus/run/asset_list.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <memory>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

struct CheckPresetOptions
{
    std::vector<std::string> files;
    bool format = false;
};

/// The device with the least force among those that come with Tactus and push; null if there is none.
std::shared_ptr<const hid::Profile> gentlest()
{
    std::shared_ptr<const hid::Profile> found;
    for (const auto& p : hid::loadProfiles (hid::profileFolder()).profiles)
        if (p->limits.guard.max_force != GuardLimits::none && (! found || p->limits.guard.max_force < found->limits.guard.max_force)) found = p;
    return found;
}

void print (const PresetForces& forces)
{
    const auto newtons = [] (double v) { return roundedText (v, 3) + " N"; };
    std::cout << "  " << forces.runs << " runs of " << roundedText (forces.lasts_s, 3) << " s: forces up to " << newtons (forces.largest)
              << ", which change by up to "
              << newtons (forces.step) << " in 1 ms\n";
    const auto device = gentlest();
    if (! device) return;
    const auto& limits = device->limits.guard;
    const double step = limits.max_slew * 1e-3;
    std::cout << "  " << device->id << ", the gentlest device that comes with Tactus, allows " << newtons (limits.max_force) << " and "
              << (step == GuardLimits::none ? "any change" : newtons (step)) << ": ";
    const bool is_short = forces.largest > limits.max_force, is_slow = forces.step > step;
    std::cout << (is_short && is_slow ? "its guard shortens and slows the force\n"
                  : is_short          ? "its guard shortens the force\n"
                  : is_slow           ? "its guard slows the force\n"
                                      : "the force passes its guard as it is\n");
}

/// A warning is something to mend, too, before a preset is shared.
Messages asErrors (Messages messages)
{
    for (auto& m : messages)
        m.severity = Message::Severity::error;
    return messages;
}

bool checkPreset (const std::string& file, bool format)
{
    const auto folder = fs::path (file).parent_path();
    const auto text = readFile (fs::path (file));
    auto loaded = loadGraph (file);
    if (report (asErrors (loaded.messages), loaded, file) > 0 || ! text) return false;
    if (format) orFail (saveGraph (loaded.graph, file));

    FileAssets files;
    AssetList assets { &files };
    const check::Subject subject { loaded.graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } } };
    auto messages = examineText (loaded, format ? writeGraph (loaded.graph) : *text, folder);
    const auto compiled = compile (subject.graph, subject.catalogue, subject.options);
    std::ranges::move (asErrors (compiled.messages), std::back_inserter (messages));
    std::ranges::move (asErrors (plan::unheardNodes (loaded.graph, catalogue())), std::back_inserter (messages));
    if (compiled.plan) std::ranges::move (examineParts (loaded.graph, *compiled.plan, assets.paths, folder), std::back_inserter (messages));
    if (report (messages, loaded, file) > 0) return false;

    const auto ticks = check::affordableTicks (*compiled.plan);
    const auto forces = playPreset (subject, folder, static_cast<double> (ticks));
    if (report (forces.messages, loaded, file) > 0) return false;
    if (report (judgePreset (subject, folder, ticks), loaded, file) > 0) return false;
    std::cout << printableName (file) << ": ok\n";
    print (forces);
    return true;
}

/// Like checkPreset(). If the argument names neither a file nor a preset, the command continues.
bool checkArgument (const std::string& argument, bool format)
try
{
    return checkPreset (graphArgument (argument), format);
}
catch (const Stop&)
{
    return false;
}
}   // namespace

void addCheckPreset (const Command& app)
{
    const auto options = std::make_shared<CheckPresetOptions>();
    const auto command = app.add ("check-preset", "Check whether graphs can be shared as presets: their descriptions, sources and licences, and their forces");
    command.addOption ("graphs", options->files, "Graph files, or names of presets").required();
    command.addFlag ("--format", options->format, "First save each file as Tactus formats it");
    addLimits (command);
    addPlugins (command);
    command.footer ("A preset has a name, a sentence about what it feels like, tags, a licence, a source for the numbers of each material,\n"
                    "knobs, and a simulated device with a hand and a guard for each role. It compiles without a warning, and reads only files of\n"
                    "its folder. In its own gesture, with each knob at each end, no guard stops or cuts off a force, the forces end, and they are\n"
                    "the same in each run.\n"
                    "Exit status 1 if anything is missing. docs/graph_file.md shows where each of these is written.\n\n"
                    "Examples:\n"
                    "  tactus check-preset my_preset.json\n"
                    "  tactus check-preset graphs/*.json");
    command.callback ([options] {
        checkEach (options->files, "presets can be shared", [&] (const std::string& file) { return checkArgument (file, options->format); });
    });
}

}   // namespace tactus::host
