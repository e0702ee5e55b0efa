// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"

#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#if ! defined(_WIN32)
#include <unistd.h>
#endif

namespace tactus::host
{

namespace
{
/// Starts `python3 -m MODULE` of the Python package in the place of this program, so its output and its exit status are those of the command. Without the
/// package, Python prints an error, and the status is that of wrong usage. No module in the current folder is loaded: its files may come from a stranger.
constexpr auto script = R"(import sys
if sys.path[:1] == [""]: del sys.path[0]
try:
    import importlib
    module = importlib.import_module(sys.argv.pop(1))
except ImportError as why:
    missing = why.name if why.name and not why.name.startswith("tactus") else "tactus"
    sys.exit(sys.stderr.write(f"error: the Python package {missing} is not installed; install it, or set PYTHONPATH to the folder python of the build\n") and 2)
sys.exit(module.main(sys.argv[1:]))
)";

[[noreturn]] void startPython (const std::string& module, const std::vector<std::string>& arguments)
{
    std::vector<std::string> words { "python3", "-c", script, module };
    words.insert (words.end(), arguments.begin(), arguments.end());
    std::cout.flush();
#if defined(_WIN32)
    throw UsageError ("this command is written in Python, and there is no Python package of Tactus for Windows; use Linux");
#else
    std::vector<char*> pointers;
    for (auto& word : words)
        pointers.push_back (word.data());
    pointers.push_back (nullptr);
    ::execvp (pointers[0], pointers.data());
    throw UsageError ("python3 cannot be started; install Python 3, and the Python package tactus");
#endif
}

struct ImportOptions
{
    std::string kind, folder, out, mass, rate, unit;
};

void run (const ImportOptions& options)
{
    std::vector<std::string> words { options.kind, options.folder, "-o", options.out };
    for (const auto& [name, value] : { std::pair { "--mass", &options.mass }, std::pair { "--rate", &options.rate }, std::pair { "--unit", &options.unit } })
        if (! value->empty()) words.insert (words.end(), { name, *value });
    startPython ("tactus.data", words);
}

/// The options of a command of tactus.lab, as they are passed on.
struct LabWords
{
    std::vector<std::string> flags;   // those that are given
    std::vector<std::pair<std::string, std::string>> values;
    std::vector<std::string> devices, positional;

    std::vector<std::string> all (std::string command) const
    {
        std::vector<std::string> words { std::move (command) };
        for (const auto& [name, value] : values)
            words.push_back (name + "=" + value);
        for (const auto& device : devices)
            words.push_back ("--device=" + device);
        words.insert (words.end(), flags.begin(), flags.end());
        words.push_back ("--");
        words.insert (words.end(), positional.begin(), positional.end());
        return words;
    }
};

std::function<void (const std::string&)> takeForLab (const std::shared_ptr<LabWords>& words, const std::string& name)
{
    return [words, name] (const std::string& value) { words->values.emplace_back (name, value); };
}
}   // namespace

void addImportData (const Command& app)
{
    const auto options = std::make_shared<ImportOptions>();
    const auto command = app.add ("import-data", "Make presets from recordings and models of others, with the Python package");
    command
        .addOption ("kind", options->kind,
                    "hatt: the Penn Haptic Texture Toolkit, one .xml a texture; lmt: the texture database of the LMT of TU Munich; "
                    "cluster: the Cluster Haptic Texture Dataset")
        .required();
    command.addOption ("folder", options->folder, "The folder with its files").required();
    command.addOption ("-o", options->out, "The folder to write presets to").required();
    command.addOption ("--mass", options->mass, "kg that turn the acceleration into a force; default: 0.05");
    command.addOption ("--rate", options->rate, "Hz of the models or recordings; default: 1000 (hatt), 10000 (lmt), from the times (cluster)");
    command.addOption ("--unit", options->unit, "m/s2 or g: the unit of the recordings of lmt; default: m/s2");
    command.footer ("Starts python3 -m tactus.data. See docs/import.md.\n\n"
                    "Example:\n"
                    "  tactus import-data hatt HaTT/Models -o textures");
    command.callback ([options] { run (*options); });
}

void addExperiment (const Command& app)
{
    struct Flags
    {
        bool resume = false, web = false, no_devices = false, packed_log = false;
    };
    const auto words = std::make_shared<LabWords>();
    const auto flags = std::make_shared<Flags>();
    const auto command = app.add ("experiment", "Run a session of an experiment with a participant, with the Python package");
    command.addOption (
               "file", [words] (const std::string& file) { words->positional.push_back (file); }, "The protocol file")
        .required();
    for (const auto& [name, about] : { std::pair { "--out", "The folder of the study; default: data" },
                                       std::pair { "--participant", "Its label, letters and digits; default: 01" },
                                       std::pair { "--session", "The label of the session; default: 01" },
                                       std::pair { "--observer", "A simulated observer: threshold=0.3,width=0.1[,lapse=...,function=...,seed=...]" },
                                       std::pair { "--devices", "The session file that binds roles to devices, or \"off\"" },
                                       std::pair { "--osc", "UDP port for marks and answers, 0 for any, or \"off\"; default: 7771" } })
        command.addOption (name, takeForLab (words, name), about);
    command.addOption ("--device", words->devices, "The device of a role: ROLE=hid:auto; may be given more than once").oneValueEach();
    command.addFlag ("--resume", flags->resume, "Go on with a session that was not completed");
    command.addFlag ("--web", flags->web, "Pages for the participant and the experimenter, for a browser on this computer");
    command.addFlag ("--no-devices", flags->no_devices, "Play no graph: nothing is felt");
    command.addFlag ("--packed-log", flags->packed_log, "Pack the log of the inputs, which takes less space");
    command.footer ("Starts python3 -m tactus.lab. See docs/lab.md.\n\n"
                    "Examples:\n"
                    "  tactus experiment roughness.json --web --participant 07\n"
                    "  tactus experiment roughness.json --web --participant 07 --resume\n"
                    "  tactus experiment grating.json --observer threshold=0.02,width=0.004 --no-devices");
    command.callback ([words, flags] {
        for (const auto& [given, name] :
             { std::pair { flags->resume, "--resume" }, std::pair { flags->web, "--web" }, std::pair { flags->no_devices, "--no-devices" },
               std::pair { flags->packed_log, "--packed-log" } })
            if (given) words->flags.emplace_back (name);
        startPython ("tactus.lab.__main__", words->all ("experiment"));
    });
}

void addStudy (const Command& app)
{
    struct Flags
    {
        bool resume = false, mixed = false, status = false, merge = false, partial = false, dry = false;
    };
    const auto words = std::make_shared<LabWords>();
    const auto flags = std::make_shared<Flags>();
    const auto command = app.add ("study", "Render a graph at many points, on one computer or a cluster, with the Python package");
    command.addOption (
               "file", [words] (const std::string& file) { words->positional.push_back (file); }, "The study file")
        .required();
    for (const auto& [name, about] : { std::pair { "--out", "The folder of results; default: the name of the study" },
                                       std::pair { "--executor", "serial, local, dask, mpi or slurm; default: local" },
                                       std::pair { "--workers", "How many processes, or shards of a Slurm job; default: one per processor" },
                                       std::pair { "--dask", "The address of a scheduler of dask.distributed; without it, a local cluster" },
                                       std::pair { "--shard", "I/N: only each N-th point, from the I-th on, from 0; does not merge" },
                                       std::pair { "--functions", "A Python file with the functions that the measures name" },
                                       std::pair { "--point", "Only render this point, from 0: its records as CSV, and its graph" },
                                       std::pair { "--to", "Also write the results as csv, h5 or mat" } })
        command.addOption (name, takeForLab (words, name), about);
    const std::vector<std::tuple<const char*, bool Flags::*, const char*>> all {
        { "--resume", &Flags::resume, "Go on with a folder that has results" },
        { "--mixed", &Flags::mixed, "Also take results of other versions and other kinds of computers, and mark them" },
        { "--status", &Flags::status, "Only say how far it is" },
        { "--merge", &Flags::merge, "Only merge the results, and make the report" },
        { "--partial", &Flags::partial, "Merge also if points are missing" },
        { "--dry-run", &Flags::dry, "Only print the script for Slurm" }
    };
    for (const auto& [name, flag, about] : all)
        command.addFlag (name, (*flags).*flag, about);
    command.footer ("Starts python3 -m tactus.lab. See docs/studies.md.\n\n"
                    "Examples:\n"
                    "  tactus study wall.json --workers 8\n"
                    "  tactus study wall.json --executor slurm --workers 100\n"
                    "  tactus study wall.json --resume\n"
                    "  tactus study wall.json --point 17");
    command.callback ([words, flags, all] {
        for (const auto& [name, flag, about] : all)
            if ((*flags).*flag) words->flags.emplace_back (name);
        startPython ("tactus.lab.__main__", words->all ("study"));
    });
}

void addMark (const Command& app)
{
    const auto words = std::make_shared<LabWords>();
    const auto command = app.add ("mark", "Mark a moment of the experiment that runs, with the Python package");
    command.addOption (
               "text", [words] (const std::string& text) { words->positional.push_back (text); }, "The name of the mark")
        .required();
    command.addOption (
        "value", [words] (const std::string& value) { words->positional.push_back (value); }, "More about it");
    command.addOption ("--osc", takeForLab (words, "--osc"), "The port of the experiment; default: 7771");
    command.footer ("Starts python3 -m tactus.lab. See docs/lab.md.\n\n"
                    "Example:\n"
                    "  tactus mark blink left");
    command.callback ([words] { startPython ("tactus.lab.__main__", words->all ("mark")); });
}

}   // namespace tactus::host
