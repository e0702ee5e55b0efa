// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

namespace tactus::host
{

/// Each adds its subcommand, with its options and examples, to the program.
void addNodes (CLI::App&);
void addValidate (CLI::App&);
void addRender (CLI::App&);
void addPlay (CLI::App&);
void addSet (CLI::App&);
void addHit (CLI::App&);
void addProbe (CLI::App&);
void addDevices (CLI::App&);
void addSession (CLI::App&);
void addBench (CLI::App&);

}   // namespace tactus::host
