// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_path.hpp"

namespace tactus::host
{

std::string resolved (const std::string& path, const std::string& folder)
{
    const std::filesystem::path given (path);
    return given.is_absolute() || folder.empty() ? given.string() : (std::filesystem::path (folder) / given).string();
}

std::string pathFrom (const std::filesystem::path& file, const std::string& folder)
{
    if (folder.empty()) return file.string();
    std::error_code problem;
    const auto from = std::filesystem::absolute (folder, problem).lexically_normal(), to = std::filesystem::absolute (file, problem).lexically_normal();
    auto relative = to.lexically_relative (from);
    if (! relative.empty() && *relative.begin() == "..")   // behind a link, ".." leads to the folder that it leads into
    {
        const auto real = std::filesystem::weakly_canonical (to.parent_path(), problem) / to.filename();
        relative = real.lexically_relative (std::filesystem::weakly_canonical (from, problem));
    }
    return relative.empty() ? file.string() : relative.generic_string();
}

}   // namespace tactus::host
