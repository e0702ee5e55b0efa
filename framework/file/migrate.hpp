// SPDX-License-Identifier: MIT
#pragma once

/// Migrates old files in numbered steps, each from one version to the next, before anything else reads them: the reader knows
/// only the newest version. A released step is never changed.

#include "graph_file.hpp"

#include <tactus/text/json.hpp>

#include <span>

namespace tactus
{

struct Migration
{
    int from;                    ///< the version that the step reads; it writes the next version
    void (*step) (Json& file);   ///< gets the whole file; may throw JsonError if the file does not conform to its version
};

struct FileFormat
{
    int version;
    std::span<const Migration> steps;
};

/// Version 2: the default of the param `load` of friction is `bound`; in version 1 it was `passive`. `deform.surface` has a setting `crease`, 30 degrees; in
/// version 1, all edges were round, as with 180. So the step writes these defaults of version 1 into the file.
void sayDefaultsOfVersion1 (Json& file);

inline constexpr Migration graph_steps[] { { 1, &sayDefaultsOfVersion1 } };

/// The format that this Tactus reads and writes.
inline constexpr FileFormat graph_format { 2, graph_steps };

/// Runs the steps from a version to the newest. Errors: file/newer_version, file/unknown_version, file/migration.
Result<> migrate (Json& file, int version, const FileFormat&);

/// Like readGraph (text), for any format. Tests use this for the order and the errors of the steps.
LoadedGraph readGraph (std::string_view text, const FileFormat&, double most_values = budgets().values);

}   // namespace tactus
