// SPDX-License-Identifier: GPL-3.0-or-later
#include "amount.hpp"
#include "commands.hpp"
#include "graph_argument.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/assets/nearest_by_embree.hpp>
#include <host/code/generate/export_graph.hpp>
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
    std::string graph, folder, target = "cpp", torque_per_volt;
    std::vector<std::string> inputs, records, sets;
    double rate_hz = 0.0;
    bool is_single = false;
};

ExportTarget targetNamed (const std::string& name)
{
    const std::vector<std::string> names { "cpp", "c-api", "arduino", "fmu", "wasm", "smartknob" };
    const auto found = std::ranges::find (names, name);
    if (found == names.end())
        throw UsageError ("--to", "there is no target " + quote (name) + didYouMean (name, names) + "; write cpp, c-api, arduino, fmu, wasm or smartknob");
    return static_cast<ExportTarget> (found - names.begin());
}

std::string nextStep (ExportTarget target, const std::string& folder)
{
    if (target == ExportTarget::smartknob) return "send it to the knob: see " + folder + "/README.md";
    if (target == ExportTarget::arduino) return "use it: copy " + folder + " into the folder libraries of Arduino";
    return "try it: make -C " + folder + (target == ExportTarget::fmu ? " fmu" : target == ExportTarget::wasm ? " wasm"
                                                                                                              : " test");
}

void run (const ExportArguments& options)
{
    const auto target = targetNamed (options.target);
    const bool is_knob = target == ExportTarget::smartknob;
    if (is_knob && (! options.inputs.empty() || ! options.records.empty())) throw UsageError ("--input, --record", "only exported code has them");
    if (! is_knob && ! options.torque_per_volt.empty()) throw UsageError ("--torque-per-volt", "only --to smartknob needs it");
    const double torque_per_volt = options.torque_per_volt.empty() ? 0.0 : readAmount ("--torque-per-volt", options.torque_per_volt, "N*m", "5 mN*m");
    const auto loaded = loadGraph (options.graph);
    if (report (loaded.messages, loaded, options.graph) > 0) throw Stop {};
    if (auto can = canWriteFolder (options.folder); ! can) fail (std::move (can).error());

    FileAssets assets;
    CompileOptions compile { .rate_hz = options.rate_hz,
                             .feeds = options.inputs,
                             .records = options.records,
                             .overrides = readSets (options.sets),
                             .assets = &assets,
                             .services = { .nearest_triangle = nearestByEmbree } };
    const auto folder = exportGraph (loaded.graph,
                                     { .file = fs::path (options.graph).filename().string(),
                                       .program = TACTUS_VERSION,
                                       .compile = std::move (compile),
                                       .target = target,
                                       .is_single = options.is_single,
                                       .knob = { .torque_per_volt = torque_per_volt },
                                       .open = {} });
    if (report (folder.messages, loaded, options.graph) > 0) throw Stop {};
    if (auto written = writeFolder (folder, options.folder); ! written) fail (written.error());
    std::cout << options.folder << ": " << (is_knob ? "detents" : folder.class_name) << " in " << folder.stem << (is_knob ? ".json, " : ".hpp, ")
              << folder.files.size() << " files\n"
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
                                                "browsers, with its JavaScript; smartknob, no code: the detents of a SmartKnob, which accepts no "
                                                "torque commands")
        .type ("cpp|c-api|arduino|fmu|wasm|smartknob");
    command.addOption ("--input", options->inputs, "Make these ports inputs of the class, such as drag.mu or drag.position.x").separatedBy (',');
    command.addOption ("--record", options->records, "Make these ports outputs of the class; default: the inputs of every sink").separatedBy (',');
    command.addOption ("--set", options->sets, "Set a parameter: NODE.PARAM=VALUE").oneValueEach();
    command.addOption ("--rate", options->rate_hz, "Ticks per second; default: the graph's").check (finiteWithin (1.0, 1e6));
    command.addFlag ("--float", options->is_single,
                     "Compute with float instead of double, for boards without hardware for doubles; positions keep more digits. With --to cpp or arduino");
    command.addOption ("--torque-per-volt", options->torque_per_volt,
                       "With --to smartknob: the torque of its motor per volt, such as \"5 mN*m\"; without it, a guess");
    addLimits (command);
    addPlugins (command);
    command.footer ("The folder needs Eigen and the standard library, but not Tactus. Its README.md says how to use it.\n\n"
                    "Examples:\n"
                    "  tactus export graphs/dry_wood.json -o dry_wood\n"
                    "  tactus export dry_wood -o dry_wood --record drag.force,drag.state\n"
                    "  make -C dry_wood test\n"
                    "  tactus export dry_wood -o dry_wood_small --float\n"
                    "  tactus export dry_wood -o dry_wood_fmu --to fmu && make -C dry_wood_fmu fmu\n"
                    "  tactus export dry_wood -o dry_wood_web --to wasm && make -C dry_wood_web wasm\n"
                    "  tactus export knob.json -o knob --to smartknob --torque-per-volt \"5 mN*m\"");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
