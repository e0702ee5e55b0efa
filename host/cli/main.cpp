// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"

#include <host/base/platform/patient_output.hpp>
#include <host/code/plugins/installed_plugins.hpp>
#include <host/tools/reports/refusal.hpp>
#include <tactus/tactus.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>

namespace
{
constexpr auto examples =
    "Examples:\n"
    "  tactus nodes                                   all node types\n"
    "  tactus nodes friction                          those of a family\n"
    "  tactus nodes friction.elasto_plastic           one datasheet\n"
    "  tactus validate graphs/*.json                  all problems in all files\n"
    "  tactus schema -o graph.schema.json             for editors, which complete and check graphs with it\n"
    "  tactus check graphs/dry_wood.json              can its devices render the graph?\n"
    "  tactus check-preset my_preset.json             can it be shared as a preset?\n"
    "  tactus limits granite_wall -o wall.png         how stiff, damped and slow may its contact be?\n"
    "  tactus render graphs/dry_wood.json --out wood.csv --plot wood.png\n"
    "  tactus spectrogram dry_wood -o wood.png        a map of its frequencies over time\n"
    "  tactus sweep dry_wood --speed 0.02..0.3 -o wood.png   a map of its frequencies over the speed of a stroke\n"
    "  tactus play graphs/dry_wood.json --duration 4  in real time\n"
    "  tactus set roughness=0.7                       while it plays\n"
    "  tactus hit ring.hit=0.4                        while it plays\n"
    "  tactus probe drag.force                        while it plays\n"
    "  tactus devices                                 connected devices and their profiles\n"
    "  tactus fake-device tactus_board                a simulated board, for tests\n"
    "  tactus session graphs/dry_wood.json            the devices bound to its roles\n"
    "  tactus fit shock tap.csv -o tap.json           a preset from a recording\n"
    "  tactus fit curve liver.csv -o liver.json       a body from an indentation\n"
    "  tactus curve hertz --young \"10 kPa\" --radius \"5 mm\"   the curve of a sphere\n"
    "  tactus export graphs/dry_wood.json -o dry_wood   C++ code for other programs\n"
    "  tactus convert effect.haptic effect.ahap         a haptic clip in another format\n"
    "  tactus render --replay run.jsonl               repeat a run logged by `play --log run.jsonl`\n"
    "  tactus experiment roughness.json --web           a session with a participant\n"
    "  tactus capture run.jsonl --test run_test.jsonl   make a clip, gesture or test from a logged run\n"
    "  tactus test run_test.jsonl                       does it still give the same bits?\n"
    "  tactus report                                    details for a problem report\n"
    "\n`tactus COMMAND --help` shows the options and more examples.";
}   // namespace

int main (int argc, char** argv)
{
    using namespace tactus::host;

    giveUpBlockedOutputs();
    if (std::getenv ("TACTUS_LANES") != nullptr)
        std::fputs ("note: TACTUS_LANES has no effect: lanes are gone, and each node computes one instance at a time\n", stderr);
    const Command app { "Tactus: haptic effects, patched like a modular synthesiser.", "tactus" };
    app.footer (examples);
    app.version (TACTUS_VERSION " (C API " + std::to_string (TACTUS_API_VERSION) + ")");
    app.requireCommand();
    addNodes (app);
    addValidate (app);
    addSchema (app);
    addCheck (app);
    addCheckPreset (app);
    addLimitsOf (app);
    addRender (app);
    addSpectrogram (app);
    addSweep (app);
    addPlay (app);
    addSet (app);
    addHit (app);
    addProbe (app);
    addDevices (app);
    addFakeDevice (app);
    addSession (app);
    addBench (app);
    addFit (app);
    addNewNode (app);
    addCurve (app);
    addCheckPlugin (app);
    addExport (app);
    addConvert (app);
    addImportData (app);
    addExperiment (app);
    addMark (app);
    addStudy (app);
    addCapture (app);
    addTest (app);
    addReport (app);

    try
    {
        // The plugin to check may be installed, and may crash: only the program that examines it loads it.
        const bool checks_plugin = argc > 1 && std::string_view (argv[1]) == "check-plugin";
        if (! checks_plugin) std::cerr << textOf (usePlugins (pluginFoldersIn (argc, argv)));
        if (const auto status = app.parse (argc, argv)) return *status == 0 ? fine : wrong_usage;
    }
    catch (const Refusal& refused)
    {
        report (refused.messages);
        return fault_of_input;
    }
    catch (const Stop&)
    {
        return fault_of_input;
    }
    catch (const std::exception& e)
    {
        std::fprintf (stderr, "tactus: error: %s\n    this should not happen; please report it, and include the command and its files\n", e.what());
        return fault_of_input;
    }
    if (! std::cout.flush())
    {
        std::fprintf (stderr, "tactus: error: writing to the standard output failed\n"
                              "    check the disk, or the program that the output is piped into [output/unwritable]\n");
        return fault_of_input;
    }
    return fine;
}
