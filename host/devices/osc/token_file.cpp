// SPDX-License-Identifier: GPL-3.0-or-later
#include "token_file.hpp"

#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/private_folder.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/ownership.hpp>

namespace tactus::host
{

namespace fs = std::filesystem;

fs::path TokenFile::pathOf (int port)
{
    const auto folder = runFolder();
    return folder.empty() ? folder : folder / ("osc-" + std::to_string (port));
}

/// The folder is closed to others before the file is there.
TokenFile::TokenFile (int port, const std::string& token)
{
    const auto path = pathOf (port);
    if (path.empty() || ! needOwnFolder (path.parent_path())) return;
    std::error_code failed;
    fs::permissions (path.parent_path(), fs::perms::owner_all, failed);
    if (failed || ! writeTextFile (path, token)) return;
    file = path;
    fs::permissions (file, fs::perms::owner_read | fs::perms::owner_write, failed);
}

TokenFile::~TokenFile()
{
    std::error_code ignored;
    if (! file.empty()) fs::remove (file, ignored);
}

std::string TokenFile::read (int port)
{
    const auto path = pathOf (port);
    if (path.empty() || ! whoElseCanChange (path).empty()) return {};
    return readTextFile (path).value_or (std::string());
}

}   // namespace tactus::host
