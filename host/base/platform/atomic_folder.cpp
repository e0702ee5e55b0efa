// SPDX-License-Identifier: MIT
#include "atomic_folder.hpp"

#include <tactus/text/quote.hpp>

#include <cerrno>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#if ! defined(_WIN32)
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace fs = std::filesystem;

#if defined(_WIN32)

class AtomicFolder::Work
{
};
Result<> AtomicFolder::check (const fs::path&, const std::string&) { return {}; }
Result<AtomicFolder> AtomicFolder::create (const fs::path& target, const std::string&)
{
    return Message::error ("output/unwritable", target.string(), "this system cannot replace a folder in one step", "use Linux");
}
Result<> AtomicFolder::write (const std::string&, std::string_view) { return {}; }
Result<> AtomicFolder::keepOthers() { return {}; }
Result<> AtomicFolder::commit() { return {}; }

#else

namespace
{
/// An open file or folder.
class FileDescriptor
{
public:
    explicit FileDescriptor (int f = -1) noexcept : file (f) {}
    FileDescriptor (FileDescriptor&& other) noexcept : file (std::exchange (other.file, -1)) {}
    FileDescriptor& operator= (FileDescriptor&& other) noexcept
    {
        std::swap (file, other.file);
        return *this;
    }
    ~FileDescriptor() { close(); }

    explicit operator bool() const noexcept { return file >= 0; }
    int number() const noexcept { return file; }

    /// False, with errno, if what was written could not be stored.
    bool close() noexcept { return file < 0 || ::close (std::exchange (file, -1)) == 0; }

private:
    int file;
};

FileDescriptor openFolder (int in, const std::string& name) noexcept
{
    return FileDescriptor { ::openat (in, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC) };
}

struct stat lookAt (int in, const std::string& name) noexcept
{
    struct stat s
    {
    };
    if (::fstatat (in, name.c_str(), &s, AT_SYMLINK_NOFOLLOW) != 0) s.st_mode = 0;
    return s;
}

bool isSame (const struct stat& a, const struct stat& b) noexcept { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

std::string systemReason() { return std::generic_category().message (errno); }

/// The names in a folder. Read whole, because the caller adds and removes some.
std::optional<std::vector<std::string>> namesIn (int folder)
{
    auto* const list = ::fdopendir (::openat (folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (list == nullptr) return std::nullopt;
    std::vector<std::string> names;
    errno = 0;
    while (const auto* entry = ::readdir (list))
        if (const std::string name = entry->d_name; name != "." && name != "..") names.push_back (name);
    const int failed = errno;
    ::closedir (list);
    errno = failed;
    return failed == 0 ? std::optional (std::move (names)) : std::nullopt;
}

/// Removes a folder of this name and what is in it. What cannot be removed stays. Follows no link, and does not leave the file system.
void removeFolder (int in, const std::string& name)
{
    if (const auto folder = openFolder (in, name))
    {
        ::fchmod (folder.number(), S_IRWXU);
        const auto device = lookAt (folder.number(), ".").st_dev;
        for (const auto& entry : namesIn (folder.number()).value_or (std::vector<std::string> {}))
        {
            const auto found = lookAt (folder.number(), entry);
            if (S_ISDIR (found.st_mode) && found.st_dev == device)
                removeFolder (folder.number(), entry);
            else
                ::unlinkat (folder.number(), entry.c_str(), 0);
        }
    }
    ::unlinkat (in, name.c_str(), AT_REMOVEDIR);
}

bool writeAll (int file, std::string_view text) noexcept
{
    while (! text.empty())
    {
        const auto done = ::write (file, text.data(), text.size());
        if (done < 0 && errno != EINTR) return false;
        if (done > 0) text.remove_prefix (static_cast<std::size_t> (done));
    }
    return true;
}

/// Copies a file. False, with errno, if that failed.
bool copyFile (int from, int to, const std::string& name)
{
    FileDescriptor in { ::openat (from, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC) };
    struct stat s
    {
    };
    if (! in || ::fstat (in.number(), &s) != 0) return false;
    errno = ENOTSUP;
    if (! S_ISREG (s.st_mode)) return false;
    FileDescriptor out { ::openat (to, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, s.st_mode & 0777) };
    if (! out) return false;
    std::vector<char> block (1u << 16u);
    for (;;)
    {
        const auto read = ::read (in.number(), block.data(), block.size());
        if (read < 0 && errno == EINTR) continue;
        if (read < 0 || ! writeAll (out.number(), { block.data(), static_cast<std::size_t> (read) })) return false;
        if (read == 0) break;
    }
    const timespec times[] { s.st_atim, s.st_mtim };
    ::futimens (out.number(), times);
    return ::fchmod (out.number(), s.st_mode & 07777) == 0 && out.close();
}

/// Gives a file that is not a folder a second name in another folder, or copies it.
bool keepFile (int from, int to, const std::string& name)
{
    if (::linkat (from, name.c_str(), to, name.c_str(), 0) == 0) return true;
    if (errno == EEXIST) return false;
    char target[4096];
    const auto length = ::readlinkat (from, name.c_str(), target, sizeof target - 1);
    if (length < 0) return copyFile (from, to, name);
    target[length] = 0;
    return ::symlinkat (target, to, name.c_str()) == 0;
}

fs::path wholeOf (const fs::path& target)
{
    std::error_code failed;
    auto whole = fs::absolute (target, failed).lexically_normal();
    return whole.has_filename() ? whole : whole.parent_path();
}

Message exists (const fs::path& target, std::string text, std::string remedy = "name a new folder")
{
    return Message::error ("output/exists", target.string(), std::move (text), std::move (remedy));
}

/// True if this program, and so probably a terminal, works in the folder. It would still be in the old one after an exchange.
bool isAroundUs (const struct stat& folder)
{
    std::error_code failed;
    for (auto at = fs::current_path (failed); ! at.empty() && ! failed; at = at.parent_path())
    {
        if (isSame (lookAt (AT_FDCWD, at.string()), folder)) return true;
        if (at == at.parent_path()) break;
    }
    return false;
}
}   // namespace

class AtomicFolder::Work
{
public:
    Work (fs::path t, std::string l) : target (std::move (t)), list (std::move (l)) {}
    Work (const Work&) = delete;
    Work& operator= (const Work&) = delete;
    ~Work()
    {
        if (hidden.empty()) return;
        removeFolder (closed.number(), fresh_name);
        removeFolder (closed.number(), old_name);
        ::unlinkat (parent.number(), hidden.c_str(), AT_REMOVEDIR);
    }

    Result<> check();
    Result<> begin();
    Result<> write (const std::string& path, std::string_view text);
    Result<> keepOthers();
    Result<> commit();

private:
    static constexpr auto fresh_name = "new", old_name = "old";

    enum class Remainder
    {
        nothing,   // of what was in the folder
        something
    };

    Message unwritable (const std::string& where, const std::string& why) const
    {
        return Message::error ("output/unwritable", where, "cannot be written: " + why, "choose another folder, create the one above it, or free some space");
    }
    Message unwritable() const { return unwritable (target.string(), systemReason()); }
    Result<> readList();
    Result<Remainder> keep (int from, int to, const std::string& place);
    bool exchange();

    const fs::path target;
    const std::string list;
    // The folder above; the earlier folder, if it is not empty; the one that only this user enters; the new one in it.
    FileDescriptor parent, old, closed, fresh;
    std::string name, hidden;       // of the target, and of `closed`; empty if there is nothing to remove
    std::set<std::string> listed;   // paths in the old folder that this one replaces
};

/// Opens the folder above and the old one.
Result<> AtomicFolder::Work::check()
{
    name = target.filename().string();
    if (name.empty()) return exists (target, "it has no folder above it");
    parent = FileDescriptor { ::open (target.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC) };
    if (! parent) return errno == ENOENT ? Result<> {} : unwritable();
    const auto found = lookAt (parent.number(), name);
    if (found.st_mode == 0) return {};
    if (S_ISLNK (found.st_mode)) return exists (target, "it is a symbolic link, which is not followed", "name the folder that it leads to, or a new one");
    if (! S_ISDIR (found.st_mode)) return exists (target, "it is not a folder");
    if (found.st_uid != ::geteuid()) return exists (target, "the folder belongs to another user");
    if (isAroundUs (found))
        return exists (target, "the current folder is in it, and it is replaced as a whole", "go to the folder above it, and name it from there");
    auto folder = openFolder (parent.number(), name);
    if (! folder) return unwritable();
    const auto names = namesIn (folder.number());
    if (! names) return unwritable();
    if (names->empty()) return {};
    if (const auto earlier = lookAt (folder.number(), list); list.empty() || ! S_ISREG (earlier.st_mode))
        return exists (target, list.empty() ? "the folder is not empty" : "the folder is not empty, and holds no earlier export");
    old = std::move (folder);
    return {};
}

Result<> AtomicFolder::Work::begin()
{
    std::error_code failed;
    fs::create_directories (target.parent_path(), failed);
    if (auto checked = check(); ! checked) return checked;
    if (! parent) return unwritable();
    auto path = (target.parent_path() / ".tactus-XXXXXX").string();
    if (::mkdtemp (path.data()) == nullptr) return unwritable();
    hidden = fs::path (path).filename().string();
    closed = openFolder (parent.number(), hidden);
    struct stat s
    {
    };
    if (! closed || ::fstat (closed.number(), &s) != 0) return unwritable();
    if (s.st_uid != ::geteuid() || (s.st_mode & 0777) != S_IRWXU)
    {
        hidden.clear();   // it is not the one that was made
        return unwritable (target.string(), "another user is changing the folder above it");
    }
    if (::mkdirat (closed.number(), fresh_name, 0777) != 0) return unwritable();
    fresh = openFolder (closed.number(), fresh_name);
    if (! fresh) return unwritable();
    return readList();
}

Result<> AtomicFolder::Work::readList()
{
    if (! old) return {};
    listed.insert (list);
    const FileDescriptor file { ::openat (old.number(), list.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC) };
    std::string text;
    std::vector<char> block (1u << 16u);
    for (;;)
    {
        const auto read = file ? ::read (file.number(), block.data(), block.size()) : -1;
        if (read < 0 && file && errno == EINTR) continue;
        if (read < 0) return unwritable ((target / list).string(), systemReason());
        if (read == 0) break;
        constexpr std::size_t longest = 1u << 24u;
        if (text.append (block.data(), static_cast<std::size_t> (read)).size() > longest)
            return exists (target / list, "it is far too long for a list of files");
    }
    for (std::size_t i = 0; i < text.size();)
    {
        const auto end = std::min (text.find ('\n', i), text.size());
        listed.insert (text.substr (i, end - i));
        i = end + 1;
    }
    return {};
}

Result<> AtomicFolder::Work::write (const std::string& path, std::string_view text)
{
    const auto where = (target / path).string();
    FileDescriptor folder { ::openat (fresh.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC) };
    for (const auto& part : fs::path (path).parent_path())
    {
        if (::mkdirat (folder.number(), part.c_str(), 0777) != 0 && errno != EEXIST) return unwritable (where, systemReason());
        folder = openFolder (folder.number(), part.string());
        if (! folder) return unwritable (where, systemReason());
    }
    const auto file_name = fs::path (path).filename().string();
    FileDescriptor file { ::openat (folder.number(), file_name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666) };
    if (! file || ! writeAll (file.number(), text) || ! file.close()) return unwritable (where, systemReason());
    return {};
}

Result<> AtomicFolder::Work::keepOthers()
{
    if (! old) return {};
    if (auto kept = keep (old.number(), fresh.number(), {}); ! kept) return std::move (kept).error();
    return {};
}

/// Keeps what is in one folder in another one. `place` is the path of both, with a slash at its end.
Result<AtomicFolder::Work::Remainder> AtomicFolder::Work::keep (int from, int to, const std::string& place)
{
    const auto names = namesIn (from);
    if (! names) return unwritable ((target / place).string(), systemReason());
    auto kept = names->empty() ? Remainder::something : Remainder::nothing;   // an empty folder is the user's
    for (const auto& entry : *names)
    {
        const auto path = place + entry, where = (target / path).string();
        const auto taken = [&] {
            return exists (where, "this file is not from an earlier export, and the new one has the same name", "move it, or name a new folder");
        };
        const auto found = lookAt (from, entry);
        if (! S_ISDIR (found.st_mode))
        {
            if (listed.contains (path)) continue;
            if (! keepFile (from, to, entry)) return errno == EEXIST ? taken() : unwritable (where, systemReason());
            kept = Remainder::something;
            continue;
        }
        if (found.st_dev != lookAt (old.number(), ".").st_dev)
            return exists (where, "another file system is mounted there", "unmount it, or name a new folder");
        const bool is_new = ::mkdirat (to, entry.c_str(), S_IRWXU) == 0;
        if (! is_new && errno != EEXIST) return unwritable (where, systemReason());
        const auto inner_from = openFolder (from, entry), inner_to = openFolder (to, entry);
        if (inner_from && ! inner_to && errno == ENOTDIR) return taken();
        if (! inner_from || ! inner_to) return unwritable (where, systemReason());
        const auto inner = keep (inner_from.number(), inner_to.number(), path + "/");
        if (! inner) return inner;
        if (is_new && *inner == Remainder::nothing)
            ::unlinkat (to, entry.c_str(), AT_REMOVEDIR);
        else if (is_new && ::fchmod (inner_to.number(), found.st_mode & 07777) != 0)
            return unwritable (where, systemReason());
        if (*inner == Remainder::something) kept = Remainder::something;
    }
    return kept;
}

/// Exchanges the old folder with the new one. False, with errno, if that failed.
bool AtomicFolder::Work::exchange()
{
#if defined(RENAME_EXCHANGE)
    if (::renameat2 (closed.number(), fresh_name, parent.number(), name.c_str(), RENAME_EXCHANGE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return false;
#endif
    if (::renameat (parent.number(), name.c_str(), closed.number(), old_name) != 0) return false;
    if (::renameat (closed.number(), fresh_name, parent.number(), name.c_str()) == 0) return true;
    const int failed = errno;
    if (::renameat (closed.number(), old_name, parent.number(), name.c_str()) != 0) hidden.clear();   // the old folder is now there, so it stays
    errno = failed;
    return false;
}

Result<> AtomicFolder::Work::commit()
{
    if (! old)   // there is nothing, or an empty folder, which a rename replaces
        return ::renameat (closed.number(), fresh_name, parent.number(), name.c_str()) == 0 ? Result<> {} : unwritable();
    const auto before = lookAt (old.number(), ".");
    const auto isOld = [&] (int in, const std::string& called) { return isSame (lookAt (in, called), before); };
    const auto disturbed = [&] { return unwritable (target.string(), "another program has replaced the folder meanwhile"); };
    if (! isOld (parent.number(), name)) return disturbed();
    const auto aside = target.parent_path() / hidden / old_name;
    if (::fchmod (fresh.number(), before.st_mode & 07777) != 0 || ! exchange())
        return hidden.empty() ? unwritable (target.string(), systemReason() + "; the old folder is now " + quotePath (aside)) : unwritable();
    if (isOld (closed.number(), fresh_name) || isOld (closed.number(), old_name)) return {};
    hidden.clear();   // what was replaced in the last moment is not this program's to remove
    return disturbed();
}

AtomicFolder::AtomicFolder (std::unique_ptr<Work> w) noexcept : work (std::move (w)) {}

Result<> AtomicFolder::check (const fs::path& target, const std::string& list) { return Work { wholeOf (target), list }.check(); }

Result<AtomicFolder> AtomicFolder::create (const fs::path& target, const std::string& list)
{
    auto made = std::make_unique<Work> (wholeOf (target), list);
    if (auto begun = made->begin(); ! begun) return std::move (begun).error();
    return AtomicFolder { std::move (made) };
}

Result<> AtomicFolder::write (const std::string& name, std::string_view text) { return work->write (name, text); }
Result<> AtomicFolder::keepOthers() { return work->keepOthers(); }
Result<> AtomicFolder::commit() { return work->commit(); }

#endif

AtomicFolder::AtomicFolder (AtomicFolder&&) noexcept = default;
AtomicFolder::~AtomicFolder() = default;

}   // namespace tactus::host
