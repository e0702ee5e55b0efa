// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "graph_argument.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/assets/file_assets.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
int checkDevices (const LoadedGraph& loaded, const std::string& file)
{
    int errors = 0;
    for (const auto& [role, description] : loaded.graph.devices)
    {
        if (errors >= static_cast<int> (most_messages))
        {
            std::cerr << printableName (file) << ": the other devices are not checked, because there are too many problems\n    fix these first\n";
            break;
        }
        Messages messages;
        auto made = makeDevice (describedByGraph (&description, role, messages), std::filesystem::path (file).parent_path());
        for (auto& m : made.messages)
        {
            m.where = "/devices/" + role + m.where;
            messages.push_back (std::move (m));
        }
        errors += report (messages, loaded, file);
    }
    return errors;
}

std::string describe (const plan::PathDelay& d)
{
    auto text = "  " + printableName (d.source) + " -> " + printableName (d.sink) + ": ";
    text += d.shortest == d.longest ? std::to_string (d.shortest) : std::to_string (d.shortest) + " to " + std::to_string (d.longest);
    text += d.longest == 1 ? " tick" : " ticks";
    return text + (d.recirculates ? ", with echoes\n" : "\n");
}

/// Reports all problems of a file. Returns true if there are none.
bool check (const std::string& file)
{
    const auto loaded = loadGraph (file);
    int errors = report (loaded.messages, loaded, file);
    if (errors > 0 && loaded.graph.root.nodes.empty()) return false;   // a file that could not be read has no further problems to report

    FileAssets assets;
    const auto compiled = compile (loaded.graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByEmbree } });
    errors += report (compiled.messages, loaded, file) + checkDevices (loaded, file);
    if (errors > 0) return false;

    for (const auto& role : compiled.plan->roles())
        if (std::ranges::count (loaded.graph.devices, role.name, &std::pair<std::string, Json>::first) == 0)
            std::cerr << printableName (file) << ": warning: no device is described for the role '" << printableName (role.name)
                      << "'\n    describe a device for it under `devices`, or give --device when you run the graph [device/undescribed]\n";
    std::cout << printableName (file) << ": ok\n";
    for (const auto& d : compiled.plan->delays())
        std::cout << describe (d);
    return true;
}

/// Like check(), for a file or the name of a preset. If the argument names neither, the command continues.
bool checkArgument (const std::string& argument)
try
{
    return check (graphArgument (argument));
}
catch (const Stop&)
{
    return false;
}
}   // namespace

void addValidate (const Command& app)
{
    const auto files = std::make_shared<std::vector<std::string>>();
    const auto command = app.add ("validate", "Check graph files and report all problems in all of them");
    command.addOption ("graphs", *files, "Graph files, or names of presets").required();
    addLimits (command);
    addPlugins (command);
    command.footer ("For each file without errors, the delay of every path from a device through the graph and back is printed:\n"
                    "each tick of delay lowers the highest stiffness that the hand can feel.\n\n"
                    "Examples:\n"
                    "  tactus validate graphs/dry_wood.json\n"
                    "  tactus validate graphs/*.json && echo fine\n"
                    "  tactus validate city.json --limits nodes=1M,memory=2GB");
    command.callback ([files] {
        bool all_fine = true;
        for (const auto& file : *files)
            all_fine = checkArgument (file) && all_fine;
        if (! all_fine) throw Stop {};
    });
}

}   // namespace tactus::host
