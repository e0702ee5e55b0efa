// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/node/setting.hpp>

#include <filesystem>
#include <string>

namespace tactus::host
{

/// A short description of a file, or the reason why it cannot be used.
struct FileText
{
    std::string text;
    bool is_problem = false;
    std::shared_ptr<const Grid> picture {};   ///< the image; null for other kinds of files
};

/// Describes a file of kind signal, image, table, or surface (a mesh). The path is as written in a graph that is stored in `folder`.
FileText describeFile (const std::string& path, SettingSheet::Kind kind, const std::string& folder, Assets&);

/// Resolves a path that is written in a graph stored in `folder`.
std::string resolved (const std::string& path, const std::string& folder);

/// The path to write in a graph: relative to its folder, if it has one.
std::string pathFrom (const std::filesystem::path& file, const std::string& folder);

}   // namespace tactus::host
