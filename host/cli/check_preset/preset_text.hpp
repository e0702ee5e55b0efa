// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/file/graph_file.hpp>
#include <tactus/plan/plan.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace tactus::host
{

/// Examines what a preset says about itself, and reports what is missing or wrong: its words, its licence, the sources of its numbers, its devices
/// and their guards. `text` is the text of the file.
///
/// Ids: preset/format, preset/name, preset/about, preset/tags, preset/rate, preset/controls, preset/licence, preset/source, preset/device,
/// preset/guard. [main thread]
Messages examineText (const LoadedGraph&, std::string_view text, const std::filesystem::path& folder);

/// Files that the preset reads and that are not in its folder, roles that it does not describe, and forces that answer late. `assets` are the files
/// that its nodes have read. Ids: preset/outside, preset/device, preset/late. [main thread]
Messages examineParts (const graph::Graph&, const Plan&, const std::set<std::string>& assets, const std::filesystem::path& folder);

}   // namespace tactus::host
