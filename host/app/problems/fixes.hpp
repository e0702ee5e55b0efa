// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/location/problem_location.hpp>

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/message.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace tactus::host
{

/// A one-click fix for a problem, with a short button label.
struct Fix
{
    std::string label;
    graph::Command command;
};

/// Empty if only the user can decide what to do.
std::optional<Fix> fixOf (const graph::Graph&, const Message&);

/// A file that a setting needs: one that is not where the setting says, or that it does not name yet.
struct MissingFile
{
    ProblemLocation at;
    SettingSheet::Kind kind;
    std::filesystem::path expected;   ///< where the file should be; empty if the setting names none
};

/// Empty if the message is about something else.
std::optional<MissingFile> missingFileOf (const graph::Graph&, const Message&);

/// Lets the setting name a file that the user has chosen.
graph::Command useFile (const graph::Graph&, const MissingFile&, const std::filesystem::path& chosen);

}   // namespace tactus::host
