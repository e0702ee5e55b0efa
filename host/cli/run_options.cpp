// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_options.hpp"

#include "graph_argument.hpp"

#include <tactus/run/turn.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/list_text.hpp>

namespace tactus::host
{

plan::Override readSet (const std::string& text)
{
    auto read = readOverride (text);
    if (! read) throw UsageError ("--set", read.error().text + "; " + read.error().remedy);
    return std::move (*read);
}

std::vector<plan::Override> readSets (const std::vector<std::string>& texts)
{
    std::vector<plan::Override> all;
    for (const auto& text : texts)
        all.push_back (readSet (text));
    return all;
}

void addLimits (const Command& app)
{
    std::string names;
    for (const auto& sheet : budget_sheets)
        addToList (names, sheet.name);
    app.addOption (
           "--limits",
           [] (const std::string& text) {
               const auto limits = readLimits (text);
               if (! limits) throw UsageError ("--limits", limits.error().text + "; " + limits.error().remedy);
               setBudgets (*limits);
           },
           "Limits on the cost of files, as in nodes=20000,memory=2GB (docs/graph_file.md); budgets: " + names)
        .type ("BUDGET=AMOUNT,…");
}

void addPlugins (const Command& app)
{
    app.addOption (
           "--plugins", [] (const std::string&) {}, "A folder of plugins, in addition to those that are installed (docs/plugins.md)")
        .type ("DIR")
        .oneValueEach();
}

void RunOptions::addTo (const Command& app, Files files)
{
    app.addOption (
           "graph", [this] (const std::string& given) { graph = graphArgument (given); },
           "A graph file, such as graphs/dry_wood.json, or the name of a preset, such as dry_wood")
        .required();
    app.addOption ("--feed", feed, "A CSV file with a column for each port that it drives, named node.port or node.port.x; a column t gives the time in s");
    if (files == Files::chosen)
    {
        app.addOption ("--record", records, "Ports to record, separated by commas; default: the inputs of every sink").separatedBy (',').oneValueEach();
        app.addOption ("--out", outputs, "Output file, .csv or .wav; may be given more than once").oneValueEach();
    }
    app.addOption ("--rate", rate_hz, "Ticks per second; default: the feed's rate, else the graph's").check (finiteWithin (1.0, 1e6));
    app.addOption ("--duration", duration_s, "Length of the run in s: of wall time if it runs in real time, or else of simulated time")
        .check (finiteWithin (1e-9, 1e9));
    app.addOption ("--ticks", ticks, "Length of the run in ticks, instead of --duration; a run in real time that loses ticks lasts longer")
        .check (within (1, 2'000'000'000));
    app.addOption ("--set", sets, "Set a parameter, NODE.PARAM=VALUE, or a control, CONTROL=0…1; may be given more than once").oneValueEach();
    app.addOption ("--device", devices,
                   "The device of a role: ROLE=FILE.json, ROLE=sim, ROLE=trace:FILE.csv, ROLE=gesture:NAME, ROLE=hid:PROFILE (hid:auto), "
                   "ROLE=serial:PROFILE@PORT, ROLE=udp:PROFILE@ADDRESS:PORT, "
                   "ROLE=audio:CARD, ROLE=DRIVER:PORT for a device driver in a plugin, or ROLE=ID to simulate the device of a profile that holds only "
                   "numbers; may be given more than once")
        .oneValueEach();
    addLimits (app);
    addPlugins (app);
}

}   // namespace tactus::host
