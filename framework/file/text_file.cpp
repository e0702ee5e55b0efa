// SPDX-License-Identifier: MIT
#include "text_file.hpp"

#include "atomic_file.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/text/budget.hpp>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace tactus
{

namespace fs = std::filesystem;

namespace
{
/// Reads to the end, or until `charge` refuses a block.
Result<std::string> readBlocks (const fs::path& path, Result<> (*charge) (std::size_t so_far, std::size_t block))
{
    const auto fail = [] {
        return Message::error ("file/unreadable", {}, errno != 0 ? std::generic_category().message (errno) : "the system gave no reason");
    };
    if (auto why = whyUnreadable (path); ! why.empty()) return Message::error ("file/unreadable", {}, std::move (why));
    errno = 0;
    std::ifstream in (path, std::ios::binary);
    if (! in) return fail();

    std::string text;
    char block[1u << 16u];
    while (in.read (block, sizeof block), in.gcount() > 0)
    {
        text.append (block, at (in.gcount()));
        if (auto charged = charge (text.size(), at (in.gcount())); ! charged) return std::move (charged).error();
    }
    if (in.bad()) return fail();
    return text;
}

Result<> chargeSize (std::size_t so_far, std::size_t)
{
    if (static_cast<double> (so_far) <= budgets().file) return {};
    return overBudget ("file/too_large", &Budgets::file, "the file", static_cast<double> (so_far), "make it smaller");
}

Result<> chargeAll (std::size_t so_far, std::size_t block)
{
    if (auto fits = chargeSize (so_far, block); ! fits) return fits;
    if (! chargeReading (static_cast<double> (block))) return overReading ("file/too_large", "this file");
    return {};
}
}   // namespace

std::string whyUnreadable (const fs::path& path)
{
    if (path.native().find (fs::path::value_type {}) != fs::path::string_type::npos) return "its name contains a zero byte";
    std::error_code failure;
    switch (fs::status (path, failure).type())
    {
    case fs::file_type::regular:
        return {};
    case fs::file_type::directory:
        return "it is a folder";
    case fs::file_type::fifo:
        return "it is a named pipe, not a file; save its output to a file";
    case fs::file_type::character:
    case fs::file_type::block:
        return "it is a device, not a file";
    case fs::file_type::socket:
        return "it is a socket, not a file";
    default:
        return failure ? failure.message() : "it is not a file";
    }
}

Result<std::string> readFile (const fs::path& path) { return readBlocks (path, chargeAll); }

std::optional<std::string> readTextFile (const fs::path& path)
{
    auto text = readBlocks (path, chargeSize);
    return text ? std::optional (std::move (*text)) : std::nullopt;
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
