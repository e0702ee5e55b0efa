// SPDX-License-Identifier: MIT
#include "atomic_file.hpp"

#include <tactus/text/ownership.hpp>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>
#include <system_error>
#include <utility>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#endif

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

/// Removes the temporary files that killed processes have left in a folder.
void removeLeftovers (const fs::path& folder)
{
    std::error_code failed;
    fs::directory_iterator entry (folder.empty() ? fs::path (".") : folder, failed);
    for (; ! failed && entry != fs::directory_iterator {}; entry.increment (failed))
    {
        const auto name = entry->path().filename().string();
        std::error_code ignored;
        if (! name.starts_with (".tactus-") || ! name.ends_with (".tmp") || ! fs::is_regular_file (entry->symlink_status (ignored))) continue;
        if (const auto lock = FileLock::takeExisting (entry->path())) fs::remove (entry->path(), ignored);
    }
}

std::unique_ptr<std::ostream> asFile (const fs::path& path)
{
    auto file = std::make_unique<std::ofstream> (path, std::ios::binary | std::ios::trunc);
    if (! *file) return nullptr;
    return file;
}

std::atomic<OpenPipe> open_pipe { asFile };

constexpr int most_partial = 99;   // unfinished files next to one target

/// NAME.partial.csv, NAME.partial-2.csv and so on. The extension stays last, so that other programs know what is in the file.
fs::path partialName (const fs::path& target, int number)
{
    auto name = target.stem();
    name += number == 1 ? std::string (".partial") : ".partial-" + std::to_string (number);
    name += target.extension();
    return target.parent_path() / name;
}

/// The permissions of the file that is replaced. If that file belongs to another user, only this user may write to the new one.
fs::perms permissionsLike (fs::perms old, const fs::path& target)
{
    return whoElseOwns (target).empty() ? old : old & ~(fs::perms::group_write | fs::perms::others_write);
}

/// Creates an empty file, and fails if there is a file of this name.
bool createNew (const fs::path& path)
{
#if defined(_WIN32)
    const int made = _wopen (path.c_str(), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);   // fopen knows no "x" there
    return made >= 0 && _close (made) == 0;
#else
    auto* const made = std::fopen (path.string().c_str(), "wbx");   // C++20 has no stream for this
    if (made == nullptr) return false;
    std::fclose (made);
    return true;
#endif
}

/// The file that would be written: a rename would replace a symbolic link.
fs::path behindLinks (const fs::path& target)
{
    std::error_code failed;
    if (! fs::is_regular_file (target, failed)) return target;
    auto behind = fs::canonical (target, failed);
    return failed ? target : behind;
}
}   // namespace

void openPipesBy (OpenPipe how) noexcept { open_pipe = how; }

std::unique_ptr<std::ostream> openDirectly (const fs::path& path)
{
    std::error_code ignored;
    const auto existing = fs::status (path, ignored);
    const bool is_file = ! fs::exists (existing) || fs::is_regular_file (existing) || fs::is_directory (existing);
    errno = 0;
    return is_file ? asFile (path) : open_pipe.load() (path);
}

bool closed (std::unique_ptr<std::ostream>& out)
{
    if (out == nullptr) return true;
    errno = 0;
    if (auto* file = dynamic_cast<std::ofstream*> (out.get()))
        file->close();   // which can fail, too
    else
        out->flush();
    const bool is_whole = out->good();
    const int why = errno;
    out.reset();
    errno = why;
    return is_whole;
}

Message AtomicFile::unwritable (const std::string& reason) const
{
    return Message::error ("output/unwritable", target.string(), "cannot be written: " + reason,
                           "choose another file, create its folder, or free some space");
}

Message AtomicFile::writeError() const
{
    const int why = errno;
    if (why == 0) return unwritable ("the system gave no reason");
    const auto reason = std::generic_category().message (why);
    return unwritable (why == ENOSPC ? "the disk is full (" + reason + ")" : reason);
}

Result<AtomicFile> AtomicFile::create (const fs::path& path, IfKilled if_killed)
{
    AtomicFile file (path);
    if (auto opened = file.open (if_killed); ! opened) return std::move (opened).error();
    return file;
}

Result<> AtomicFile::open (IfKilled if_killed)
{
    std::error_code ignored;
    if (const auto who = whoElseLinks (target); ! who.empty()) return unwritable (who);
    const auto existing = fs::status (target, ignored);
    if (fs::is_directory (existing))
        return unwritable ("it is a folder");
    const bool direct = fs::exists (existing) && ! fs::is_regular_file (existing);
    if (fs::is_regular_file (existing))
    {
        target = behindLinks (target);
        errno = 0;   // a rename would ignore the write protection of a file
        if (! std::ofstream (target, std::ios::binary | std::ios::app)) return writeError();
    }
    if (const auto folder = target.parent_path(); ! direct && ! folder.empty() && ! fs::is_directory (folder, ignored))
        return unwritable ("there is no folder " + folder.string());

    errno = 0;
    if (direct)
    {
        out = openDirectly (target);
        if (out == nullptr) return writeError();
        return {};
    }
    if (auto opened = openTemporary (if_killed); ! opened) return opened;
    if (fs::is_regular_file (existing)) fs::permissions (temporary, permissionsLike (existing.permissions(), target), ignored);
    return {};
}

Result<> AtomicFile::openTemporary (IfKilled if_killed)
{
    removeLeftovers (target.parent_path());
    const bool kept = if_killed == IfKilled::kept;
    const int tries = kept ? most_partial : 3;
    for (int i = 1; i <= tries; ++i)
    {
        const auto name = kept ? partialName (target, i) : temporaryIn (target.parent_path());
        errno = 0;
        if (! createNew (name))
        {
            if (errno == EEXIST) continue;
            return writeError();
        }
        temporary = name;
        out = openDirectly (temporary);
        if (out == nullptr) return writeError();
        // Before the lock is taken, another process may have removed the file as a leftover. The last try also serves file
        // systems without locks, where no process removes leftovers.
        if (lockTemporary() || kept || i == tries) return {};
        discard();
    }
    return unwritable ("there are " + std::to_string (most_partial) + " unfinished files next to it, such as " + partialName (target, 1).string());
}

bool AtomicFile::lockTemporary()
{
    if constexpr (FileLock::open_is_locked) return true;
    lock = FileLock::takeExisting (temporary);
    std::error_code failed;
    return lock && fs::exists (temporary, failed);
}

AtomicFile::AtomicFile (AtomicFile&& other) noexcept
    : target (std::move (other.target)), temporary (std::exchange (other.temporary, {})), out (std::move (other.out)), lock (std::move (other.lock))
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
        lock = std::move (other.lock);
    }
    return *this;
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() noexcept
{
    out.reset();
    if (temporary.empty()) return;
    std::error_code ignored;
    fs::remove (temporary, ignored);
    temporary.clear();
    lock.reset();
}

Result<> AtomicFile::commit()
{
    if (! closed (out)) return writeError();
    if (temporary.empty()) return {};

    std::error_code failure;
    fs::rename (temporary, target, failure);
    if (failure) return unwritable (failure.message());
    temporary.clear();
    lock.reset();
    return {};
}

std::vector<fs::path> leftUnfinished (const fs::path& target)
{
    std::vector<fs::path> left;
    const auto written = behindLinks (target);
    for (int i = 1; i <= most_partial; ++i)
    {
        const auto name = partialName (written, i);
        std::error_code failed;
        if (! fs::is_regular_file (fs::symlink_status (name, failed))) continue;
        if (FileLock::takeExisting (name)) left.push_back (name);
    }
    return left;
}

}   // namespace tactus
