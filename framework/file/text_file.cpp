// SPDX-License-Identifier: MIT
#include "text_file.hpp"

#include "atomic_file.hpp"

#include <iterator>

namespace tactus
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

Result<> writeTextFile (const fs::path& path, const std::string& text)
{
    std::error_code failed;
    fs::create_directories (path.parent_path(), failed);
    auto file = AtomicFile::create (path);
    if (! file) return std::move (file).error();
    if (! file->stream().write (text.data(), static_cast<std::streamsize> (text.size()))) return file->writeError();
    return file->commit();
}

}   // namespace tactus
