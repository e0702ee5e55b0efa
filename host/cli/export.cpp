// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "graph_argument.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/code/generate/export_graph.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
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

struct ExportArguments
{
    std::string graph, folder, target = "cpp";
    std::vector<std::string> inputs, records, sets;
    double rate_hz = 0.0;
    bool is_single = false;
};

ExportTarget targetNamed (const std::string& name)
{
    const std::vector<std::string> names { "cpp", "c-api", "arduino", "fmu", "wasm" };
    if (name == "smartknob")
        throw UsageError ("--to", "the configuration of a SmartKnob is no longer exported; write cpp, c-api, arduino, fmu or wasm");
    const auto found = std::ranges::find (names, name);
    if (found == names.end())
        throw UsageError ("--to", "there is no target " + quote (name) + didYouMean (name, names) + "; write cpp, c-api, arduino, fmu or wasm");
    return static_cast<ExportTarget> (found - names.begin());
}

std::string nextStep (ExportTarget target, const std::string& folder)
{
    if (target == ExportTarget::arduino) return "use it: copy " + folder + " into the folder libraries of Arduino";
    return "try it: make -C " + folder + (target == ExportTarget::fmu ? " fmu" : target == ExportTarget::wasm ? " wasm"
                                                                                                              : " test");
}

void run (const ExportArguments& options)
{
    const auto target = targetNamed (options.target);
    const auto loaded = loadGraph (options.graph);
    if (report (loaded.messages, loaded, options.graph) > 0) throw Stop {};
    if (auto can = canWriteFolder (options.folder); ! can) fail (std::move (can).error());

    FileAssets assets;
    CompileOptions compile { .rate_hz = options.rate_hz,
                             .feeds = options.inputs,
                             .records = options.records,
                             .overrides = readSets (options.sets),
                             .assets = &assets,
                             .services = { .nearest_triangle = nearestByBoxes } };
    const auto folder = exportGraph (loaded.graph,
                                     { .file = fs::path (options.graph).filename().string(),
                                       .program = TACTUS_VERSION,
                                       .compile = std::move (compile),
                                       .target = target,
                                       .is_single = options.is_single,
                                       .open = {} });
    if (report (folder.messages, loaded, options.graph) > 0) throw Stop {};
    if (auto written = writeFolder (folder, options.folder); ! written) fail (written.error());
    std::cout << options.folder << ": " << folder.class_name << " in " << folder.stem << ".hpp, " << folder.files.size() << " files\n"
              << nextStep (target, options.folder) << "\n";
}
}   // namespace

void addExport (const Command& app)
{
    const auto options = std::make_shared<ExportArguments>();
    const auto command = app.add ("export", "Write a graph as C++ code that computes the same bits: for firmware, simulators and other programs");
    command
        .addOption (
            "graph", [options] (const std::string& given) { options->graph = graphArgument (given); },
            "A graph file, such as graphs/dry_wood.json, or the name of a preset, such as dry_wood")
        .required();
    command.addOption ("-o,--out", options->folder, "The folder to write: new, empty, or an earlier export, which is replaced").required();
    command.addOption ("--to", options->target, "What to write: cpp, a C++20 class with a self-test; c-api, the same with a C interface; arduino, a "
                                                "library for boards; fmu, a unit for simulators (FMI 2.0); wasm, a WebAssembly module for "
                                                "browsers, with its JavaScript")
        .type ("cpp|c-api|arduino|fmu|wasm");
    command.addOption ("--input", options->inputs, "Make these ports inputs of the class, such as drag.mu or drag.position.x").separatedBy (',');
    command.addOption ("--record", options->records, "Make these ports outputs of the class; default: the inputs of every sink").separatedBy (',');
    command.addOption ("--set", options->sets, "Set a parameter: NODE.PARAM=VALUE").oneValueEach();
    command.addOption ("--rate", options->rate_hz, "Ticks per second; default: the graph's").check (finiteWithin (1.0, 1e6));
    command.addFlag ("--float", options->is_single,
                     "Compute with float instead of double, for boards without hardware for doubles; positions keep more digits. With --to cpp or arduino");
    addLimits (command);
    addPlugins (command);
    command.footer ("The folder needs Eigen and the standard library, but not Tactus. Its README.md says how to use it.\n\n"
                    "Examples:\n"
                    "  tactus export graphs/dry_wood.json -o dry_wood\n"
                    "  tactus export dry_wood -o dry_wood --record drag.force,drag.state\n"
                    "  make -C dry_wood test\n"
                    "  tactus export dry_wood -o dry_wood_small --float\n"
                    "  tactus export dry_wood -o dry_wood_fmu --to fmu && make -C dry_wood_fmu fmu\n"
                    "  tactus export dry_wood -o dry_wood_web --to wasm && make -C dry_wood_web wasm");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
