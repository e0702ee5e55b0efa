// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/assets/file_assets.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/generate/export_graph.hpp>
#include <host/platform/preset_folder.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

struct Options
{
    std::string graph, folder, target = "cpp";
    std::vector<std::string> inputs, records, sets;
    double rate_hz = 0.0;
};

/// Refuses targets that do not exist.
void check (const std::string& target)
{
    if (target == "cpp") return;
    const std::vector<std::string> planned { "c-api", "arduino", "fmu" };
    const bool is_planned = std::ranges::count (planned, target) > 0;
    auto names = planned;
    names.emplace_back ("cpp");
    throw UsageError ("--to", is_planned ? "the target " + quote (target) + " does not exist yet; write --to cpp"
                                         : "there is no target " + quote (target) + didYouMean (target, names) + "; write --to cpp");
}

void run (const Options& options)
{
    check (options.target);
    const auto loaded = loadGraph (options.graph);
    if (report (loaded.messages, loaded, options.graph) > 0) throw Stop {};
    if (! canWriteFolder (options.folder))
        fail ("output/exists", "the folder " + quote (options.folder) + " is not empty, and holds no earlier export", "name a new folder with -o");

    FileAssets assets;
    CompileOptions compile { .rate_hz = options.rate_hz,
                             .feeds = options.inputs,
                             .records = options.records,
                             .overrides = readSets (options.sets),
                             .assets = &assets,
                             .services = { .nearest_triangle = nearestByEmbree } };
    const auto folder = exportGraph (
        loaded.graph,
        { .file = fs::path (options.graph).filename().string(), .program = TACTUS_VERSION, .compile = std::move (compile), .open = {} });
    if (report (folder.messages, loaded, options.graph) > 0) throw Stop {};
    if (auto written = writeFolder (folder, options.folder); ! written) fail (written.error());
    std::cout << options.folder << ": " << folder.class_name << " in " << folder.stem << ".hpp, " << folder.files.size() << " files\n"
              << "try it: make -C " << options.folder << " test\n";
}
}   // namespace

void addExport (const Command& app)
{
    const auto options = std::make_shared<Options>();
    const auto command = app.add ("export", "Write a graph as C++ code that computes the same bits: for firmware, simulators and other programs");
    command
        .addOption (
            "graph", [options] (const std::string& given) { options->graph = graphFile (given); },
            "A graph file, such as graphs/dry_wood.json, or the name of a preset, such as dry_wood")
        .required();
    command.addOption ("-o,--out", options->folder, "The folder to write: new, empty, or an earlier export, which is replaced").required();
    command.addOption ("--to", options->target, "What to write: cpp, a C++20 class with a self-test").type ("cpp");
    command.addOption ("--input", options->inputs, "Make these ports inputs of the class, such as drag.mu or drag.position.x").separatedBy (',');
    command.addOption ("--record", options->records, "Make these ports outputs of the class; default: the inputs of every sink").separatedBy (',');
    command.addOption ("--set", options->sets, "Set a parameter: NODE.PARAM=VALUE").oneValueEach();
    command.addOption ("--rate", options->rate_hz, "Ticks per second; default: the graph's").check (finiteWithin (1.0, 1e6));
    addLimits (command);
    addPlugins (command);
    command.footer ("The folder needs Eigen and the standard library, and nothing of Tactus. Its README.md says how to use it.\n\n"
                    "Examples:\n"
                    "  tactus export graphs/dry_wood.json -o dry_wood\n"
                    "  tactus export dry_wood -o dry_wood --record drag.force,drag.state\n"
                    "  make -C dry_wood test");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
