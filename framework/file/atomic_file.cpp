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
/// A name that no other process and no other file of this process uses. It contains a random number per process and a counter.
fs::path temporaryIn (const fs::path& folder)
{
    static const std::random_device::result_type process = std::random_device {}();
    static std::atomic<unsigned> count { 0 };

    std::ostringstream name;
    name << ".tactus-" << std::hex << process << '-' << count++ << ".tmp";
    return folder / name.str();
}
}   // namespace

Message AtomicFile::unwritable (const std::string& reason) const
{
    return Message::error ("output/unwritable", target.string(), "cannot be written: " + reason,
                           "choose another file, create its folder, or free some space");
}

Message AtomicFile::writeError() const { return unwritable (errno != 0 ? std::generic_category().message (errno) : "the system gave no reason"); }

Result<AtomicFile> AtomicFile::create (const fs::path& path)
{
    AtomicFile file (path);
    if (auto opened = file.open(); ! opened) return std::move (opened).error();
    return file;
}

Result<> AtomicFile::open()
{
    std::error_code ignored;
    const auto existing = fs::status (target, ignored);
    if (fs::is_directory (existing))
        return unwritable ("it is a folder");
    const bool direct = fs::exists (existing) && ! fs::is_regular_file (existing);
    if (fs::is_regular_file (existing))
    {
        // A rename would replace a symbolic link, and ignore the write protection of a file.
        if (const auto behind_link = fs::canonical (target, ignored); ! ignored) target = behind_link;
        errno = 0;
        if (! std::ofstream (target, std::ios::binary | std::ios::app)) return writeError();
    }
    if (const auto folder = target.parent_path(); ! direct && ! folder.empty() && ! fs::is_directory (folder, ignored))
        return unwritable ("there is no folder " + folder.string());

    const auto opened = direct ? target : temporaryIn (target.parent_path());
    errno = 0;
    out.open (opened, std::ios::binary);
    if (! out) return writeError();
    if (! direct) temporary = opened;
    if (fs::is_regular_file (existing)) fs::permissions (temporary, existing.permissions(), ignored);
    return {};
}

AtomicFile::AtomicFile (AtomicFile&& other) noexcept
    : target (std::move (other.target)), temporary (std::exchange (other.temporary, {})), out (std::move (other.out))
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

Result<> AtomicFile::commit()
{
    errno = 0;
    out.close();
    if (! out) return writeError();
    if (temporary.empty()) return {};

    std::error_code failure;
    fs::rename (temporary, target, failure);
    if (failure) return unwritable (failure.message());
    temporary.clear();
    return {};
}

}   // namespace tactus
