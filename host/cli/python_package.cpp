// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"

#include <iostream>
#include <memory>
#include <string>
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
#if ! defined(_WIN32)
    std::vector<char*> pointers;
    for (auto& word : words)
        pointers.push_back (word.data());
    pointers.push_back (nullptr);
    ::execvp (pointers[0], pointers.data());
#endif
    throw UsageError ("python3 cannot be started; install Python 3, and the Python package tactus");
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

/// A command of tactus.lab, which reads the arguments itself.
void addOfLab (const Command& app, const std::string& name, const std::string& about)
{
    app.add (name, about).passOn ([name] (const std::vector<std::string>& given) {
        std::vector<std::string> words { name };
        words.insert (words.end(), given.begin(), given.end());
        startPython ("tactus.lab.__main__", words);
    });
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

void addExperiment (const Command& app) { addOfLab (app, "experiment", "Run a session of an experiment, with the Python package (docs/lab.md)"); }

void addMark (const Command& app) { addOfLab (app, "mark", "Mark a moment of the experiment that runs, with the Python package (docs/lab.md)"); }

}   // namespace tactus::host
