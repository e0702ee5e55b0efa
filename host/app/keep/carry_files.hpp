// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// Copies the files that a graph names relative to its folder (meshes, pictures, recordings, other graphs) to another one
/// that it is saved in, where they are not there yet. Returns those that could not be copied, as the graph names them.
/// [main thread]
std::vector<std::string> carryFiles (const graph::Graph&, const std::filesystem::path& to_folder);

}   // namespace tactus::host
