// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_file.hpp"

#include <framework/file/atomic_file.hpp>

#include <iterator>

namespace tactus::host
{

namespace fs = std::filesystem;

std::optional<std::string> readTextFile (const fs::path& path)
{
    std::error_code failed;
    if (! fs::is_regular_file (path, failed)) return std::nullopt;
    std::ifstream in (path, std::ios::binary);
    if (! in) return std::nullopt;
    return std::string (std::istreambuf_iterator<char> (in), {});
}

std::optional<std::string> writeTextFile (const fs::path& path, const std::string& text)
{
    std::error_code failed;
    fs::create_directories (path.parent_path(), failed);
    AtomicFile file (path);
    if (file.refused()) return file.refused();
    if (! file.stream().write (text.data(), static_cast<std::streamsize> (text.size()))) return AtomicFile::lastReason();
    return file.commit();
}

}   // namespace tactus::host
