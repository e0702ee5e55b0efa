// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/io/atomic_file.hpp>

#include <atomic>
#include <cerrno>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
Error unwritable (const fs::path& target, std::string what, std::string remedy = "choose another file or make room for this one")
{
    return { .id = "output/unwritable",
             .where = target.string(),
             .what = "cannot be written: " + std::move (what),
             .remedy = std::move (remedy) };
}

std::string reasonFromErrno()
{
    return errno != 0 ? std::generic_category().message (errno) : "the system gives no reason";
}

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

tl::expected<AtomicFile, Error> AtomicFile::create (fs::path target)
{
    std::error_code ignored;
    const auto existing = fs::status (target, ignored);

    if (fs::is_directory (existing))
        return tl::unexpected (unwritable (target, "it is a folder", "give a file name in it"));

    AtomicFile file;
    file.target = target;

    if (fs::exists (existing) && ! fs::is_regular_file (existing))
    {
        errno = 0;
        file.out.open (target, std::ios::binary);
        if (! file.out)
            return tl::unexpected (unwritable (target, reasonFromErrno()));
        return file;
    }

    if (fs::is_regular_file (existing))
    {
        // The link is to stay a link, and a file that is write-protected is so on purpose: a rename would ignore both.
        if (const auto behind_link = fs::canonical (target, ignored); ! ignored)
            file.target = behind_link;

        errno = 0;
        if (! std::ofstream (file.target, std::ios::binary | std::ios::app))
            return tl::unexpected (unwritable (target, reasonFromErrno()));
    }

    if (const auto folder = file.target.parent_path(); ! folder.empty() && ! fs::is_directory (folder, ignored))
        return tl::unexpected (unwritable (target, "there is no folder " + folder.string(), "make the folder first"));

    const auto temporary = temporaryIn (file.target.parent_path());
    errno = 0;
    file.out.open (temporary, std::ios::binary);
    if (! file.out)
        return tl::unexpected (unwritable (target, reasonFromErrno()));

    file.temporary = temporary;
    if (fs::is_regular_file (existing))
        fs::permissions (temporary, existing.permissions(), ignored);
    return file;
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

AtomicFile::~AtomicFile()
{
    discard();
}

void AtomicFile::discard() noexcept
{
    out.close();
    if (! temporary.empty())
    {
        std::error_code ignored;
        fs::remove (temporary, ignored);
        temporary.clear();
    }
}

tl::expected<void, Error> AtomicFile::commit()
{
    errno = 0;
    out.close();
    if (! out)
        return tl::unexpected (writeFailed());

    if (! temporary.empty())
    {
        std::error_code failure;
        fs::rename (temporary, target, failure);
        if (failure)
            return tl::unexpected (unwritable (target, failure.message()));
        temporary.clear();
    }
    return {};
}

Error AtomicFile::writeFailed() const
{
    return unwritable (target, reasonFromErrno());
}

}   // namespace tactus::host
