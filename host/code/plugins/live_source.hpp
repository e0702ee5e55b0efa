// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// C++ (or C) code that becomes a plugin.
struct LiveSource
{
    std::filesystem::path file;                       ///< the header of a node, or the plugin that CMake builds: for messages
    std::vector<std::filesystem::path> sources {};    ///< empty: the header `file` is compiled, and its TACTUS_NODE line names the node
    std::vector<std::filesystem::path> includes {};   ///< folders, in addition to those of Tactus
    std::vector<std::string> definitions {};          ///< macros, as NAME or NAME=VALUE
    std::string compiler {};                          ///< empty: CXX from the environment, or else `c++` (C: `cc`)

    /// The sources, and the headers in their folders. Without sources: only the header `file`.
    std::vector<std::filesystem::path> watched() const;

    bool isC() const;   ///< all sources are C

    /// Checks that only this user and root can have written the sources. Error: live/foreign.
    Result<> trusted() const;
};

/// The code of a node that is only a header. Ids: live/no_header.
Result<LiveSource> liveHeader (const std::filesystem::path&);

/// Reads what tactus_add_plugin has written next to a plugin about how to build it. Ids: live/no_build_file, live/foreign.
Result<LiveSource> liveBuild (const std::filesystem::path& plugin);

/// The plugins in this catalogue that have been built on this machine, so that their code can be watched.
std::vector<LiveSource> liveBuilds (const Catalogue&);

/// The text of the C++ file that makes a plugin of a header. Ids: live/no_node.
Result<std::string> sourceFor (const std::filesystem::path& header);

}   // namespace tactus::host
