// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>
#include <framework/message.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <variant>

namespace tactus::host
{

/// A graph as it is now, with the ids of its nodes and wires and the files that it includes, so that what is compiled from
/// it later is the same. What settings name (meshes, recordings, pictures) is named with a hash of its content, and not
/// contained. Paths are relative to `folder`.
Json snapshotOf (const graph::Graph&, const std::set<std::string>& assets, const std::filesystem::path& folder);

/// The graph of a snapshot, or why there is none. `where` of a message is a JSON pointer into the snapshot.
/// Ids: log/graph. [main thread]
std::variant<graph::Graph, Message> readSnapshot (const Json&, const std::filesystem::path& folder);

/// A message for each file that is gone or not what it was. Ids: log/asset_missing, log/asset_changed.
Messages checkAssets (const Json& snapshot, const std::filesystem::path& folder);

}   // namespace tactus::host
