// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>

#include <filesystem>

namespace tactus::host
{

/// The graph as a file in another folder has to say it, so that the relative paths in it (to meshes, pictures, recordings, clips, other graphs)
/// lead to the same files. What lies in the folder of the graph is copied to the same place in the other folder; if something else is there, it
/// stays, and the copy gets another name. Files outside of the folder of the graph, and those that cannot be copied, stay where they are. The
/// graph itself keeps its folder and its paths, which the steps of its history have, too. [main thread]
graph::Graph carriedTo (const std::filesystem::path& folder, const graph::Graph&);

}   // namespace tactus::host
