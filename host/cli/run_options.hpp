// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/command_line/command.hpp>
#include <tactus/plan/compile.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// The options that render and play share.
struct RunOptions
{
    std::string graph, feed;
    std::vector<std::string> records, outputs, sets, devices;
    std::string log;       ///< the run log to write; "": none
    std::string clock;     ///< the role whose device ticks the run, "timer" or "audio"; "": the session's choice, or the first device that can tick the run
    std::string session;   ///< for a live run, the session that binds its roles to devices: a file, or "off"; "": the user's session
    bool watch = false;    ///< files are read again when they are edited, and without --duration, the run lasts until it is stopped
    bool strict = false;   ///< true: a missing device of the session ends the run
    std::vector<std::string> routes;
    std::string card;      ///< the sound card: TYPE:NAME, TYPE or NAME; "": the session's choice, or else any card
    std::string capture;   ///< the WAV file for the signal to the sound card; "": none
    double rate_hz = 0.0, duration_s = 0.0;
    int ticks = 0;   ///< the length of the run instead of duration_s: a live run that loses ticks lasts longer; 0: not given

    /// `Files::chosen`: adds --record and --out, too.
    enum class Files
    {
        chosen,
        fixed   ///< the command decides what is recorded, and into which file
    };
    void addTo (const Command&, Files = Files::chosen);
};

/// Adds --limits. Parsing it sets the budgets of files (framework/text/budget.hpp).
void addLimits (const Command&);

/// Adds --plugins. main() has read it already, because the nodes must be known first.
void addPlugins (const Command&);

/// Parses NODE.PARAM=VALUE, as in --set.
plan::Override readSet (const std::string&);

/// Parses all --set options.
std::vector<plan::Override> readSets (const std::vector<std::string>&);

}   // namespace tactus::host
