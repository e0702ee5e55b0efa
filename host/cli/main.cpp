// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"

#include <cstdio>
#include <exception>
#include <iostream>

int main (int argc, char** argv)
{
    using namespace tactus::host;

    CLI::App app { "Tactus: haptic effects, patched like a modular synthesiser.", "tactus" };
    app.footer ("Examples:\n"
                "  tactus nodes                                   every node there is\n"
                "  tactus nodes friction.elasto_plastic           one datasheet\n"
                "  tactus validate graphs/*.json                  everything wrong with them, at once\n"
                "  tactus render graphs/dry_wood.json --out wood.csv --plot wood.png\n"
                "  tactus play graphs/dry_wood.json --duration 4  in real time\n"
                "  tactus set roughness=0.7                       while it plays\n"
                "  tactus hit ring.hit=0.4                        likewise\n"
                "  tactus probe drag.force                        likewise\n"
                "  tactus devices                                 what is plugged in, and whether it fits\n"
                "  tactus session graphs/dry_wood.json            which devices stand behind its roles\n"
                "  tactus render --replay run.jsonl               once more what `play --log run.jsonl` wrote down\n"
                "\n`tactus COMMAND --help` shows the options and more examples.");
    app.set_version_flag ("--version", TACTUS_VERSION);
    app.require_subcommand (1);
    addNodes (app);
    addValidate (app);
    addRender (app);
    addPlay (app);
    addSet (app);
    addHit (app);
    addProbe (app);
    addDevices (app);
    addSession (app);
    addBench (app);

    try
    {
        app.parse (argc, argv);
    }
    catch (const CLI::ParseError& e)
    {
        const bool asked_for_help = e.get_exit_code() == static_cast<int> (CLI::ExitCodes::Success);
        app.exit (e);
        return asked_for_help ? fine : wrong_usage;
    }
    catch (const Stop&)
    {
        return fault_of_input;
    }
    catch (const std::exception& e)
    {
        std::fprintf (stderr, "tactus: error: %s\n    this should not happen; please report it with the command and its files\n", e.what());
        return fault_of_input;
    }
    if (! std::cout.flush())
    {
        std::fprintf (stderr, "tactus: error: the standard output could not be written\n    check the disk, or the program it is piped into [output/unwritable]\n");
        return fault_of_input;
    }
    return fine;
}
