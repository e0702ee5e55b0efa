// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace tactus
{

/// The current graph with the ids of its nodes and wires and the files it includes, so that it compiles to the same
/// plan later. Files named by settings (meshes, recordings, pictures) are not included; their names are stored with a hash of
/// the content. Paths are relative to `folder`.
Json snapshotOf (const graph::Graph&, const std::set<std::string>& assets, const std::filesystem::path& folder);

/// Reads the graph of a snapshot, or returns why it cannot be read. `where` in a message is a JSON pointer into the snapshot.
/// Ids: log/graph. [main thread]
Result<graph::Graph> readSnapshot (const Json&, const std::filesystem::path& folder);

/// Returns a message for each file that is missing or has changed. Ids: log/asset_missing, log/asset_changed.
Messages checkAssets (const Json& snapshot, const std::filesystem::path& folder);

/// The same snapshot with its paths relative to another folder.
Json movedSnapshot (Json snapshot, const std::filesystem::path& from_folder, const std::filesystem::path& to_folder);

/// A hash of the texts of the graph and of the files that it includes. It does not depend on the folders of these files.
std::string snapshotHash (const Json& snapshot);

}   // namespace tactus
