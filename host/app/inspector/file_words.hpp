// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/assets.hpp>
#include <framework/setting.hpp>

#include <filesystem>
#include <string>

namespace tactus::host
{

/// What a file holds, in a few words, or what is wrong with it.
struct FileWords
{
    std::string text;
    bool is_wrong = false;
    std::shared_ptr<const Grid> picture {};   ///< of an image
};

/// `what` is of kind signal, image, table, or surface for a mesh. The path is as written in the graph, whose folder that is.
FileWords wordsOn (const std::string& path, SettingSheet::Kind what, const std::string& folder, Assets&);

/// Where a file is that a graph in a folder names.
std::string resolved (const std::string& path, const std::string& folder);

/// A file as a graph in a folder names it: relative to that, where there is a folder.
std::string pathFrom (const std::filesystem::path& file, const std::string& folder);

}   // namespace tactus::host
