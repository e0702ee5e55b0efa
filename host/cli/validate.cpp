// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "graph_argument.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/plan/rules/unheard.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <utility>

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

/// The place where a role is first named in the graph; "" if it is named only in an included file.
std::string placeOfRole (const graph::Graph& g, const std::string& role)
{
    const auto in = [&] (const graph::Patch& patch, const std::string& where) -> std::string {
        for (const auto& n : patch.nodes)
        {
            const auto node = where + "/nodes/" + pointerPart (n.name);
            if (n.role == role) return node + "/role";
            for (const auto& [inner, outer] : n.roles.items())
                if (outer == role || (outer.is_array() && std::ranges::count (outer, Json (role)) > 0)) return node + "/roles/" + pointerPart (inner);
        }
        return {};
    };
    auto place = in (g.root, "");
    for (const auto& [name, patch] : g.graphs)
        if (place.empty()) place = in (patch, "/graphs/" + pointerPart (name));
    return place;
}

/// Warns about roles without a device.
Messages undescribedRoles (const graph::Graph& g, const Plan& plan)
{
    std::vector<std::string> described;
    for (const auto& [role, description] : g.devices)
        described.push_back (role);
    Messages messages;
    for (const auto& role : plan.roles())
        if (std::ranges::count (described, role.name) == 0)
            messages.push_back (Message::warning ("device/undescribed", placeOfRole (g, role.name),
                                                  "no device is described for the role '" + role.name + "'" + didYouMean (role.name, described),
                                                  "describe a device for it under `devices`, or give --device when you run the graph"));
    return messages;
}

/// The problems that compiling has found, in the order of the file, without those of a part that could not even be read: these are reported
/// already.
Messages ordered (Messages messages, const LoadedGraph& loaded, const std::string& file)
{
    std::erase_if (messages, [&] (const Message& m) {
        return std::ranges::any_of (loaded.messages, [&] (const Message& l) {
            return l.severity == Message::Severity::error && ! l.where.empty() && m.file.empty() && l.file == file
                   && (m.where + '/').starts_with (l.where + '/');
        });
    });
    const auto place = [&] (const Message& m) {
        const auto at = m.file.empty() ? loaded.positionOf (m.where) : TextPosition {};
        return std::pair (at.line, at.column);
    };
    std::ranges::stable_sort (messages, {}, place);
    return messages;
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
    const auto compiled = compile (loaded.graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
    auto messages = compiled.messages;
    std::ranges::move (plan::unheardNodes (loaded.graph, catalogue()), std::back_inserter (messages));
    if (compiled.plan) std::ranges::move (undescribedRoles (loaded.graph, *compiled.plan), std::back_inserter (messages));
    const bool has_warnings = ! loaded.messages.empty() || ! messages.empty();   // no errors, if it comes to that
    errors += report (ordered (std::move (messages), loaded, file), loaded, file) + checkDevices (loaded, file);
    if (errors > 0) return false;

    std::cout << printableName (file) << (has_warnings ? ": ok, with warnings\n" : ": ok\n");
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
