// SPDX-License-Identifier: MIT
#pragma once

/// Old files are brought up to date in numbered steps, each from one version to the next, before anything else reads
/// them: the reader knows the newest version only. A step that has been released is never changed.

#include "graph_file.hpp"

#include <framework/json.hpp>

#include <span>

namespace tactus
{

struct Migration
{
    int from;                    ///< the version it reads; it writes the next
    void (*step) (Json& file);   ///< the whole file; may throw Json::exception on one that is not as it should be
};

struct FileFormat
{
    int version;
    std::span<const Migration> steps;
};

/// What this Tactus reads and writes. Version 1 is the first there is, so there are no steps yet.
inline constexpr FileFormat graph_format { 1, {} };

/// Runs the steps from a version to the newest. Returns what is wrong with the version, or with the file on the way:
/// file/newer_version, file/unknown_version, file/migration.
Messages migrate (Json& file, int version, const FileFormat&);

/// As readGraph (text), for any format: how the mechanism is tested as long as there is nothing to migrate.
LoadedGraph readGraph (std::string_view text, const FileFormat&);

}   // namespace tactus
