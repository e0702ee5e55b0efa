// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/command_line/command.hpp>
#include <host/tools/fitting/fitting.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// The options that all commands `tactus fit KIND` share.
struct FitCommandOptions
{
    std::string recording, preset, plot;
    std::vector<std::string> columns, units, signs;   ///< ROLE=…
    bool json = false;
    FitSettings settings {};
};

/// A command `tactus fit KIND` under construction.
struct FitCommand
{
    FitKind kind {};
    Command command;
    std::shared_ptr<FitCommandOptions> options;

    /// Adds the option with this name of the table of options (fit_options.hpp). `example`: a value with its unit, "2 N"; empty: a plain number.
    void add (const std::string& name, const std::string& example, const std::string& about) const;
};

/// Adds a command with the recording, --out, --plot, --json, --column and --unit, which fits and reports.
FitCommand addFitKind (const Command& fit, FitKind, const std::string& about, const std::string& footer);

// Each is in a separate file.
void addFitFriction (const Command& fit);
void addFitModes (const Command& fit);
void addFitTexture (const Command& fit);
void addFitGrating (const Command& fit);
void addFitBlade (const Command& fit);
void addFitCurve (const Command& fit);
void addFitSwitch (const Command& fit);
void addFitShock (const Command& fit);

}   // namespace tactus::host
