// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// A preset as one file, `NAME.tactus`: a ZIP archive with the graph as `graph.json`, and the files that it names beside it.

#include <tactus/text/result.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// A file in an archive, by its path from the top: "assets/grain.wav".
struct PackedFile
{
    std::string name, bytes;
};

/// True if the name ends in .tactus.
bool isPresetPack (const std::filesystem::path&);

/// The bytes of an archive that readPresetPack would read. The same files give the same bytes. Ids: as for readPresetPack.
Result<std::string> presetPack (const std::vector<PackedFile>&);

/// Reads an archive, which may come from a stranger. Refuses links, hidden names, names that occur twice and paths out of it. The archive must be
/// within the budget `file`, the number of its files within `files`, and their unpacked size within `reading`, whatever sizes it claims. It must have a
/// graph.json. No path in the nodes and devices of its graphs may lead out of it; whether the files exist is not checked. Ids: those of readFile,
/// pack/not_a_pack, pack/name, pack/twice, pack/too_many, pack/too_large, pack/damaged, pack/no_graph, pack/outside. [any thread]
Result<std::vector<PackedFile>> readPresetPack (const std::filesystem::path&);

/// Unpacks an archive into a new folder that only this user can enter, and returns the path of its graph. The folder is removed when the program exits
/// normally. Ids: those of readPresetPack, output/unwritable. [any thread]
Result<std::filesystem::path> unpackPreset (const std::filesystem::path&);

}   // namespace tactus::host
