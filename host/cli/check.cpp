// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "graph_argument.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/tools/reports/check_report.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/json_writer.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
struct CheckCommandOptions : CheckOptions
{
    std::string graph;
    std::vector<std::string> devices, sets;
    double rate_hz = 0.0;
    bool json = false;
};

std::string padded (std::string_view text, std::size_t width) { return std::string (text) + std::string (width > text.size() ? width - text.size() : 1, ' '); }

std::string number (double v) { return roundedText (v, 3); }

std::string describe (const check::Condition& c)
{
    const auto about = ! c.axis.empty() ? "axis " + c.axis : c.node.empty() ? std::string ("-")
                                                                            : c.node;
    auto line = "  " + padded (nameOf (c.verdict), 12) + padded (c.id, 18) + padded (printableName (about), 16);
    if (c.verdict != check::Verdict::not_reached)
    {
        const auto compared = c.isKnown() ? check::describe (c.value, c.limit) : number (c.value) + " of ?";
        line += padded (compared + (c.unit == "1" ? "" : " " + std::string (c.unit)), 28);
    }
    if (c.isKnown()) line += padded ("margin " + (std::isnan (c.margin()) ? "?" : number (c.margin())), 18);
    line += std::string (c.law) + '\n';
    if (c.verdict == check::Verdict::holds) return line;
    line += "              " + c.text + '\n';
    if (! c.remedy.empty()) line += "              " + std::string (c.verdict == check::Verdict::unknown ? "" : "would help: ") + c.remedy + '\n';
    return line;
}

/// The profiles that break no condition of a role. Profiles without a damping are left out: `stiffness` cannot be judged for them.
std::string ableDevices (const check::Demand& demand, const std::string& role, const check::JudgeOptions& options, const hid::LoadedProfiles& profiles)
{
    std::string names;
    for (const auto& profile : profiles.profiles)
    {
        const auto numbers = hid::numbersOf (*profile);
        if (! numbers.damping) continue;
        const std::vector<check::RoleDevice> devices { { role, numbers, profile->id } };
        auto all = check::judge (demand, devices, options);
        std::erase_if (all, [&] (const check::Condition& c) { return c.role != role; });
        if (! check::isBroken (all)) addToList (names, profile->id);
    }
    return names;
}

void print (const CheckCommandOptions& options, const CheckReport& report, const hid::LoadedProfiles& profiles)
{
    const auto& [demand, devices, trials, judge, conditions] = report;
    std::cout << printableName (options.graph) << " at " << numberText (demand.rate_hz) << " Hz: "
              << check::scopeOf (demand, judge, options.sweep ? "a sweep" : "the hand's motion")
              << '\n';
    for (const auto& n : check::notJudged (demand, conditions, judge))
        std::cout << "not judged: " << (n.role.empty() ? "" : "of " + printableName (n.role) + ", ") << n.what << ": " << n.why << '\n';
    for (const auto& role : demand.roles)
    {
        if (! role.axis.empty()) continue;   // its conditions stand below those of its tool
        const auto device = std::ranges::find (devices, role.role, &check::RoleDevice::role);
        std::cout << printableName (role.role) << " on " << printableName (device->name) << ": " << check::describe (device->numbers) << '\n';
        bool is_broken = false;
        for (const auto& c : conditions)
            if (c.role == role.role)
            {
                std::cout << describe (c);
                is_broken = is_broken || c.isBroken();
            }
        if (const auto able = is_broken ? ableDevices (demand, role.role, options.judge, profiles) : ""; ! able.empty())
            std::cout << "  profiles that break no condition, as far as their numbers are known and without trials: " << able << '\n';
    }
    const auto broken = std::ranges::count_if (conditions, &check::Condition::isBroken);
    std::cout << (broken == 0 ? "no judged condition is broken" : std::to_string (broken) + (broken == 1 ? " condition is broken" : " conditions are broken"))
              << "; not everything can be judged: try it by hand\n";
}

void run (const CheckCommandOptions& options)
{
    FileAssets assets;
    CheckedGraph graph { loadGraph (options.graph), options.graph, assets, { options.devices, readSets (options.sets), options.rate_hz } };
    const CheckReport found { graph, options };
    report (graph.takeWarnings());
    if (options.json)
        std::cout << writeJson (found.json());
    else
        print (options, found, graph.profiles);
    if (check::isBroken (found.conditions))
    {
        std::cout.flush();
        throw Stop {};
    }
}
}   // namespace

void addCheck (const Command& app)
{
    const auto options = std::make_shared<CheckCommandOptions>();
    const auto command = app.add ("check", "Check whether the devices of a graph can render it: stability, quanta, friction, textures, forces");
    command
        .addOption (
            "graph", [options] (const std::string& given) { options->graph = graphArgument (given); }, "The graph file, or the name of a preset")
        .required();
    command.addOption ("--device", options->devices,
                       "The device of a role: ROLE=PROFILE, ROLE=FILE.json (a profile or a device), ROLE=sim or ROLE=DRIVER:PORT (whose numbers are "
                       "unknown); ROLE=gesture:NAME and ROLE=trace:FILE.csv choose the hand of a role; may be given more than once")
        .oneValueEach();
    command.addFlag ("--sweep", options->sweep, "Sweep the workspaces of the devices instead of following the hands");
    command.addOption ("--speed", options->judge.speed, "Speed of strokes over textures in m/s; default: the measured speed").check (finiteWithin (1e-6, 1e3));
    command.addOption ("--rate", options->rate_hz, "Ticks per second; default: the graph's rate").check (finiteWithin (1.0, 1e6));
    command.addOption ("--duration", options->duration_s, "Length of the motion in s").check (finiteWithin (1e-3, 60.0));
    command.addOption ("--set", options->sets, "Set a parameter, NODE.PARAM=VALUE, or a control, CONTROL=0…1; may be given more than once").oneValueEach();
    command.addOption ("--alpha", options->judge.factors.alpha, "Required samples per period of a texture; default 2, recommended 10")
        .check (finiteWithin (1e-3, 1e6));
    command.addOption ("--beta", options->judge.factors.beta, "Required position quanta per period of a texture; default 2, recommended 10")
        .check (finiteWithin (1e-3, 1e6));
    command.addOption ("--gamma", options->judge.factors.gamma, "Required force quanta per amplitude of a texture; default 10")
        .check (finiteWithin (1e-3, 1e6));
    command.addFlag ("--json", options->json, "Print JSON, for use by programs");
    addLimits (command);
    addPlugins (command);
    command.footer ("Exit status 1 if a condition is broken. docs/check.md explains each condition.\n\n"
                    "Examples:\n"
                    "  tactus check dry_wood\n"
                    "  tactus check graphs/dry_wood.json --device stylus=tactus_board --rate 1000\n"
                    "  tactus check graphs/dry_wood.json --device stylus=gesture:circle --speed 0.3\n"
                    "  tactus check graphs/dry_wood.json --json | jq '.conditions[] | select(.verdict == \"broken\")'");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
