// SPDX-License-Identifier: MIT
#include "ownership.hpp"

#include "quote.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#if ! defined(_WIN32)
#include <fcntl.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <vector>
#if defined(__linux__)
#include <sys/xattr.h>
#endif
#endif

namespace tactus
{

namespace fs = std::filesystem;

namespace
{
constexpr int most_links = 40;   // as in Linux
}

#if defined(_WIN32)

std::string whoElseCanChange (const fs::path&)
{
    return {};
}
std::string whoElseOwns (const fs::path&) { return {}; }

Result<TrustedFile> TrustedFile::open (const fs::path& path)
{
    TrustedFile made { -1 };
    made.stable = path.string();
    return made;
}

TrustedFile::~TrustedFile() = default;
void TrustedFile::keepPath() noexcept {}

#else

namespace
{
/// Asks the user database about this user or group, and gives the entry to `use`. The functions of the database need a buffer.
template <typename Entry, typename Find, typename Use>
void askDatabase (Find find, unsigned id, Use use)
{
    Entry entry {};
    Entry* found = nullptr;
    std::vector<char> buffer (1u << 14u);
    if (find (id, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr) use (*found);
}

std::string userName (uid_t id)
{
    std::string name;
    askDatabase<passwd> (::getpwuid_r, id, [&] (const passwd& user) { name = user.pw_name; });
    return name;
}

/// True if this user alone is in the group: many systems give each user such a group, and let it write to all that the user makes.
bool isOwnGroup (gid_t id)
{
    gid_t own = ~id;
    std::string name;
    askDatabase<passwd> (::getpwuid_r, ::geteuid(), [&] (const passwd& user) {
        own = user.pw_gid;
        name = user.pw_name;
    });
    bool is_own = false;
    if (own == id) askDatabase<group> (::getgrgid_r, id, [&] (const group& g) {
        is_own = name == g.gr_name;
        for (auto* const* member = g.gr_mem; *member != nullptr; ++member)
            is_own = is_own && name == *member;
    });
    return is_own;
}

/// True if the file has an access list, which may let further users write to it. The bits of the group then apply to all of them.
bool hasAccessList ([[maybe_unused]] const std::string& path)
{
#if defined(__linux__)
    return ::getxattr (path.c_str(), "system.posix_acl_access", nullptr, 0) > 0;
#else
    return false;
#endif
}

std::string reason() { return std::generic_category().message (errno); }

const char* nameOfKind (const struct stat& s) { return S_ISDIR (s.st_mode) ? "folder" : S_ISLNK (s.st_mode) ? "link"
                                                                                                            : "file"; }

enum class Place
{
    on_the_way,
    end
};

std::string what (const struct stat& s, const std::string& path) { return std::string ("the ") + nameOfKind (s) + " " + quotePath (path); }

/// A sentence about the other user who owns this one, which is called `path`. Empty if there is none.
std::string ownerOf (const struct stat& s, const std::string& path)
{
    if (s.st_uid == ::geteuid() || s.st_uid == 0) return {};
    const auto name = userName (s.st_uid);
    return what (s, path) + " belongs to " + (name.empty() ? "user number " + std::to_string (s.st_uid) : "the user " + printableName (name));
}

/// A sentence that names another user who can change the file or folder `path`. Empty if no other user can.
std::string whoElse (const struct stat& s, const std::string& path, Place place = Place::end)
{
    if (auto owner = ownerOf (s, path); ! owner.empty()) return owner;
    const bool is_sticky = S_ISDIR (s.st_mode) && (s.st_mode & S_ISVTX) != 0;
    if (S_ISLNK (s.st_mode) || (is_sticky && place == Place::on_the_way)) return {};
    if ((s.st_mode & S_IWOTH) != 0) return "every user may write to " + what (s, path);
    if ((s.st_mode & S_IWGRP) != 0 && (! isOwnGroup (s.st_gid) || hasAccessList (path))) return "other users may write to " + what (s, path);
    return {};
}

std::string targetOf (const std::string& link)
{
    std::array<char, 4096> target {};
    const auto length = ::readlink (link.c_str(), target.data(), target.size());
    return length > 0 ? std::string (target.data(), static_cast<std::size_t> (length)) : std::string();
}
}   // namespace

// From the root down. No other user can change what belongs to this user or to root in a folder that was checked, so it stays as it was.
std::string whoElseCanChange (const fs::path& path)
{
    std::error_code failed;
    const auto whole = fs::absolute (path, failed);
    std::vector<fs::path> left (whole.begin(), whole.end());
    std::ranges::reverse (left);
    fs::path reached = "/";
    int links = 0;
    for (;;)
    {
        struct stat s
        {
        };
        if (::lstat (reached.c_str(), &s) != 0) return errno == ENOENT || errno == ENOTDIR ? std::string() : quotePath (reached.string()) + ": " + reason();
        if (auto who = whoElse (s, reached.string(), left.empty() ? Place::end : Place::on_the_way); ! who.empty()) return who;
        if (S_ISLNK (s.st_mode))
        {
            const fs::path target = targetOf (reached.string());
            if (target.empty() || ++links > most_links) return "the link " + quotePath (reached.string()) + " leads nowhere";
            const std::vector<fs::path> parts (target.begin(), target.end());
            left.insert (left.end(), parts.rbegin(), parts.rend());
            reached = reached.parent_path();
        }
        if (left.empty()) return {};
        const auto next = std::move (left.back());
        left.pop_back();
        if (next.is_absolute())
            reached = "/";
        else if (next == "..")
            reached = reached.parent_path();
        else if (! next.empty() && next != ".")
            reached /= next;
    }
}

std::string whoElseOwns (const fs::path& path)
{
    struct stat s
    {
    };
    return ::lstat (path.c_str(), &s) == 0 ? ownerOf (s, path.string()) : std::string();
}

Result<TrustedFile> TrustedFile::open (const fs::path& path)
{
    std::error_code failed;
    const auto whole = fs::absolute (path, failed).string();                                     // the system's loader would look elsewhere for a bare name
    TrustedFile made { ::open (whole.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC) };   // a pipe without a writer does not block
    struct stat s
    {
    };
    if (made.file < 0 || ::fstat (made.file, &s) != 0) return Message::error ("file/unreadable", {}, reason());
    if (! S_ISREG (s.st_mode)) return Message::error ("file/unreadable", {}, "it is not a regular file");
    if (auto who = whoElse (s, whole); ! who.empty()) return Message::error ("file/foreign", {}, std::move (who));
    made.stable = whole;
#if defined(__linux__)
    if (! whoElseCanChange (whole).empty())
    {
        made.is_by_number = true;
        made.stable = "/proc/self/fd/" + std::to_string (made.file);
    }
#endif
    return made;
}

void TrustedFile::keepPath() noexcept
{
    if (is_by_number) file = -1;
}

TrustedFile::~TrustedFile()
{
    if (file >= 0) ::close (file);
}

#endif

std::string whoElseLinks (fs::path path)
{
    std::error_code failed;
    for (int links = 0; links < most_links && fs::is_symlink (path, failed); ++links)
    {
        if (auto who = whoElseOwns (path); ! who.empty()) return who;
        path = path.parent_path() / fs::read_symlink (path, failed);
    }
    return {};
}

TrustedFile::TrustedFile (TrustedFile&& other) noexcept
    : file (std::exchange (other.file, -1)), is_by_number (other.is_by_number), stable (std::move (other.stable))
{
}

}   // namespace tactus
