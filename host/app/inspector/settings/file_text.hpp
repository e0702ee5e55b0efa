// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/text/file_path.hpp>
#include <host/base/assets/file_assets.hpp>

#include <tactus/kit/assets.hpp>
#include <tactus/node/setting.hpp>

#include <memory>
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

}   // namespace tactus::host
