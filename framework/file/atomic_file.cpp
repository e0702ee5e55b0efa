// SPDX-License-Identifier: MIT
#include "atomic_file.hpp"

#include <cerrno>
#include <fstream>
#include <random>
#include <system_error>

namespace tactus
{
namespace fs = std::filesystem;

namespace
{
std::string lastReason() { return errno != 0 ? std::generic_category().message (errno) : "the system gives no reason"; }

/// Beside the target: a rename is only atomic within one file system.
fs::path temporaryFor (const fs::path& target)
{
    std::random_device random;
    auto name = target.filename();
    name += std::to_string (random()).insert (0, 1, '.') + ".tmp";
    return target.parent_path() / name;
}
}   // namespace

std::optional<std::string> writeWhole (const fs::path& path, std::string_view text)
{
    std::error_code ignored, failure;
    auto target = path;
    const auto existing = fs::status (path, ignored);
    if (fs::is_directory (existing)) return "it is a folder";
    if (fs::exists (existing))
    {
        if (! fs::is_regular_file (existing)) return "it is not a regular file";
        target = fs::canonical (path, failure);
        if (failure) return failure.message();

        // A file that is write-protected is so on purpose; the rename would not ask.
        errno = 0;
        if (! std::ofstream (target, std::ios::binary | std::ios::app)) return lastReason();
    }

    const auto temporary = temporaryFor (target);
    errno = 0;
    std::ofstream out (temporary, std::ios::binary);
    if (! out) return lastReason();
    out.write (text.data(), static_cast<std::streamsize> (text.size()));
    out.close();
    if (! out)
    {
        const auto reason = lastReason();
        fs::remove (temporary, ignored);
        return reason;
    }
    if (fs::exists (existing)) fs::permissions (temporary, existing.permissions(), ignored);
    fs::rename (temporary, target, failure);
    if (! failure) return std::nullopt;
    fs::remove (temporary, ignored);
    return failure.message();
}

}   // namespace tactus
