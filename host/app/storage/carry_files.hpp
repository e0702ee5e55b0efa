// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// For a graph that is saved in another folder: copies the files that it names by a relative path (meshes, pictures, recordings,
/// other graphs) to that folder, unless they exist there. Returns the files that could not be copied, as named in the graph.
/// [main thread]
std::vector<std::string> carryFiles (const graph::Graph&, const std::filesystem::path& to_folder);

}   // namespace tactus::host
