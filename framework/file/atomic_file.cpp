// SPDX-License-Identifier: MIT
#include "atomic_file.hpp"

#include <atomic>
#include <cerrno>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>

namespace tactus
{

namespace fs = std::filesystem;

namespace
{
/// Two processes, or two files of one process, never meet: a number drawn once a process, and a count.
fs::path temporaryIn (const fs::path& folder)
{
    static const std::random_device::result_type process = std::random_device {}();
    static std::atomic<unsigned> count { 0 };

    std::ostringstream name;
    name << ".tactus-" << std::hex << process << '-' << count++ << ".tmp";
    return folder / name.str();
}
}   // namespace

std::string AtomicFile::lastReason() { return errno != 0 ? std::generic_category().message (errno) : "the system gives no reason"; }

AtomicFile::AtomicFile (fs::path wanted) : target (std::move (wanted)) { open(); }

void AtomicFile::open()
{
    std::error_code ignored;
    const auto existing = fs::status (target, ignored);
    if (fs::is_directory (existing))
    {
        refusal = "it is a folder";
        return;
    }
    const bool direct = fs::exists (existing) && ! fs::is_regular_file (existing);
    if (fs::is_regular_file (existing))
    {
        // The link is to stay a link, and a file that is write-protected is so on purpose: a rename would ignore both.
        if (const auto behind_link = fs::canonical (target, ignored); ! ignored) target = behind_link;
        errno = 0;
        if (! std::ofstream (target, std::ios::binary | std::ios::app))
        {
            refusal = lastReason();
            return;
        }
    }
    if (const auto folder = target.parent_path(); ! direct && ! folder.empty() && ! fs::is_directory (folder, ignored))
    {
        refusal = "there is no folder " + folder.string();
        return;
    }

    const auto opened = direct ? target : temporaryIn (target.parent_path());
    errno = 0;
    out.open (opened, std::ios::binary);
    if (! out)
    {
        refusal = lastReason();
        return;
    }
    if (! direct) temporary = opened;
    if (fs::is_regular_file (existing)) fs::permissions (temporary, existing.permissions(), ignored);
}

AtomicFile::AtomicFile (AtomicFile&& other) noexcept
    : target (std::move (other.target)), temporary (std::exchange (other.temporary, {})), out (std::move (other.out)), refusal (std::move (other.refusal))
{
}

AtomicFile& AtomicFile::operator= (AtomicFile&& other) noexcept
{
    if (this != &other)
    {
        discard();
        target = std::move (other.target);
        temporary = std::exchange (other.temporary, {});
        out = std::move (other.out);
        refusal = std::move (other.refusal);
    }
    return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept
{
    out.close();
    if (temporary.empty()) return;
    std::error_code ignored;
    fs::remove (temporary, ignored);
    temporary.clear();
}

std::optional<std::string> AtomicFile::commit()
{
    errno = 0;
    out.close();
    if (! out) return lastReason();
    if (temporary.empty()) return std::nullopt;

    std::error_code failure;
    fs::rename (temporary, target, failure);
    if (failure) return failure.message();
    temporary.clear();
    return std::nullopt;
}

}   // namespace tactus
