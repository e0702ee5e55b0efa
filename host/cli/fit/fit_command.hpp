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
    Command command;
    std::shared_ptr<FitCommandOptions> options;

    /// An option with a unit, such as --load "2 N". `take` receives the value in SI.
    void addAmount (const std::string& option, const char* si_unit, const char* example, const std::string& about,
                    const std::function<void (FitSettings&, double)>& take) const;

    /// The same for a place or a time, which may be 0 or negative.
    void addSignedAmount (const std::string& option, const char* si_unit, const char* example, const std::string& about,
                          const std::function<void (FitSettings&, double)>& take) const;
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
