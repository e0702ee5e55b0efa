// SPDX-License-Identifier: MIT
// tactus-check-plugin, the program that `tactus check-plugin` starts.
#include "check_plugin.hpp"

#include <host/base/command_line/command.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <system_error>

namespace
{
constexpr int fine = 0, failed = 1, wrong_usage = 2;   // as in host/cli/report.hpp

constexpr const char* footer =
    "A higher level means more examinations (2 adds memory, adopt and state, 3 threads and passivity) and more random trials. Trial k uses the\n"
    "seed S + k; a failure names its seed, so `--seed` repeats it immediately.\n"
    "Of a device driver, --open DESCRIPTION also examines a device: its readings, timeouts, limits, and how it comes to rest.\n"
    "The time per tick is printed but not judged. Exit status 1 if anything failed.\n\n"
    "Examples:\n"
    "  tactus check-plugin rough_wood/build/rough_wood.tactus\n"
    "  tactus check-plugin rough_wood.tactus --strict 10 --seed 7\n"
    "  tactus check-plugin rough_wood.tactus --json > report.json\n"
    "  tactus check-plugin serial_arm.tactus-device --open '{\"port\": \"/dev/ttyACM0\"}'";
}   // namespace

int main (int argc, char** argv)
{
    using namespace tactus;

    check_plugin::Options options;
    std::string file;
    int seed = static_cast<int> (options.seed);
    bool json = false;
    const host::Command app { "Load a plugin in separate processes, and check that its nodes or its device driver meet all requirements",
                              "tactus check-plugin" };
    app.addOption ("plugin", file, "The file of the plugin").required();
    app.addOption ("--strict", options.level, "How thoroughly, from 1 to 10; default: 5").check (host::within (1, 10));
    app.addOption ("--seed", seed, "The seed of the first random trial; default: 1").check (host::within (0, std::numeric_limits<int>::max()));
    app.addOption ("--cpu-seconds", options.cpu_seconds, "The CPU time that loading, or one call of a function of a node, may take; default: 5")
        .check (host::within (1, 3600));
    app.addOption ("--open", options.device, "Of a device driver: the description of a device to open, as JSON. It gets no force");
    app.addFlag ("--json", json, "Print JSON, for use by programs");
    app.footer (footer);
    try
    {
        if (const auto status = app.parse (argc, argv)) return *status == 0 ? fine : wrong_usage;
        options.seed = static_cast<unsigned> (seed);
        if (const auto device = Json::tryParse (options.device); ! options.device.empty() && (! device || ! device->is_object()))
        {
            std::fprintf (stderr, "tactus check-plugin: error: --open needs a JSON object, as in --open '{\"port\": \"/dev/ttyACM0\"}'\n");
            return wrong_usage;
        }
        std::error_code unseen;
        options.file = std::filesystem::absolute (file, unseen);   // the system's loader looks for a name without a slash in other folders
        const auto report = check_plugin::checkPlugin (options);
        std::cout << (json ? jsonOf (report).dump (2) + "\n" : textOf (report)) << std::flush;
        return report.failures() == 0 ? fine : failed;
    }
    catch (const std::exception& e)
    {
        std::fprintf (stderr, "tactus check-plugin: error: %s\n", e.what());
        return failed;
    }
}
