// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <vector>

namespace tactus::host
{

/// The files in other folders that the graph names, by their whole paths, and that may go along if the person agrees: see carriedTo(). [main thread]
std::vector<std::filesystem::path> filesElsewhere (const graph::Graph&);

/// Writes a graph with the files that it names as one file, which readPresetPack() reads. Files below the folder of the graph go along, as carriedTo() says,
/// and those of filesElsewhere() that the person has agreed to. Ids: share/outside (it names another file elsewhere), share/name (no archive can have the
/// name of a file), and those of readFile, presetPack and writeTextFile. [main thread]
Result<> sharePreset (const graph::Graph&, const std::filesystem::path&, const std::vector<std::filesystem::path>& agreed = {});

}   // namespace tactus::host
