// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>

namespace tactus::host
{

/// Writes a graph with the files that it names as one file, which readPresetPack() reads. Files below the folder of the graph go along, as carriedTo() says.
/// Ids: share/outside (it names a file elsewhere), share/name (no archive can have the name of a file), and those of readFile, presetPack
/// and writeTextFile. [main thread]
Result<> sharePreset (const graph::Graph&, const std::filesystem::path&);

}   // namespace tactus::host
