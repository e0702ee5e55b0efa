// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A file that goes along with a graph into another folder.
struct CarriedFile
{
    std::filesystem::path name;           ///< below that folder
    std::filesystem::path from;           ///< the file to copy
    std::optional<std::string> text {};   ///< what to write instead: a graph whose own files have other names there
};

struct CarriedGraph
{
    graph::Graph graph;
    std::vector<CarriedFile> files;
    std::vector<std::filesystem::path> elsewhere;   ///< files of the kinds below in other folders that the graph names; none is hidden or below a hidden folder
};

/// The graph as a file in another folder has to say it, so that the relative paths in it lead to the same files, and the files that have to be
/// copied there first. Nothing is written yet.
///
/// A file goes along only if it is the recording, picture, table, mesh, included graph or trace that the catalogue or the driver of a simulated device
/// expects at its place, has the extension of one, and is below the folder of the graph, in which neither it nor a folder on the way is hidden or a link.
/// So a graph of a stranger cannot name a start script that is next to it. Nothing goes where Tactus reads plugins, profiles and sessions. What is in the
/// other folder stays, and a copy gets another name. All other files stay where they are, and the path leads there, also if there is no file now.
/// A file `elsewhere` goes along, into a folder `assets`, if it is in `from_elsewhere`: the person has agreed to it.
///
/// The graph itself keeps its folder and its paths, which the steps of its history have, too. With `only`, other names are not copied.
/// [main thread]
CarriedGraph carriedTo (const std::filesystem::path& folder, const graph::Graph&, const std::optional<std::vector<std::filesystem::path>>& only = {},
                        const std::vector<std::filesystem::path>& from_elsewhere = {});

/// Copies the files. Refuses to replace anything, and to write through a link. Ids: save/in_the_way, and those of readFile and writeTextFile.
Result<> copyInto (const std::filesystem::path& folder, const std::vector<CarriedFile>&);

}   // namespace tactus::host
