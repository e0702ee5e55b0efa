// SPDX-License-Identifier: MIT
#pragma once

#include "sources.hpp"

#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tactus::host
{

/// The headers of nodes that come from plugins, for exports. They are read and copied, and nothing of them runs here. [main thread]
class PluginSources
{
public:
    static constexpr std::size_t most_bytes = 1 << 20, most_files = 256;   ///< of a header; of headers that are looked at, per plugin

    /// Looks for the header of a node: in the folders of the sources from which the plugin was built on this computer, next to the plugin, and
    /// where its package installs headers. Keeps the header and what it includes next to it. The error, export/plugin, says where it looked,
    /// or what of the header cannot be exported.
    Result<> add (const NodeType&);

    /// By id. Their headers are listed in files().
    const std::map<std::string, NodeClass, std::less<>>& classes() const noexcept { return known; }

    /// The text of each header, by its path in the export: "plugins/rough_wood/rough_wood.hpp".
    const std::map<std::string, std::string>& files() const noexcept { return texts; }

private:
    Result<> keep (const std::filesystem::path& base, const std::string& relative, const std::string& folder);

    std::map<std::string, NodeClass, std::less<>> known;
    std::map<std::string, std::string> texts;
};

/// The folders in which the header of a plugin's nodes is looked for, in this order.
std::vector<std::filesystem::path> headerFoldersOf (const std::filesystem::path& plugin);

}   // namespace tactus::host
