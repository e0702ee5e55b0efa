// SPDX-License-Identifier: MIT
#pragma once

#include "result.hpp"

#include <filesystem>
#include <string>

namespace tactus
{

/// Who, apart from this user and root, can change what is at a path, as a sentence: "the folder '/tmp/x' belongs to the user eve". Empty if
/// nobody can. Looks at what is there and at every folder and link on the way to it. Each must belong to this user or to root. Others may
/// write only to folders on the way that have the sticky bit, such as /tmp, where nobody can replace what belongs to somebody else. If there
/// is nothing at the path, only the folders above it count. On Windows, always empty. [any thread]
std::string whoElseCanChange (const std::filesystem::path&);

/// The same for the owner of what is at a path itself: a link is not followed, and permissions do not count. [any thread]
std::string whoElseOwns (const std::filesystem::path&);

/// The same for the links at the end of a path, all of which writing to it would follow. A link of another user would choose which file of
/// this user is written. Linux itself does not follow such links in folders such as /tmp, but it cannot see that a rename would. [any thread]
std::string whoElseLinks (std::filesystem::path);

/// An open file with code, which only this user and root could have written: what it contains will run as this user. [any thread]
class TrustedFile
{
public:
    /// Errors, without a remedy: file/unreadable, file/foreign (somebody else could have written the file).
    static Result<TrustedFile> open (const std::filesystem::path&);

    TrustedFile (TrustedFile&&) noexcept;
    TrustedFile& operator= (TrustedFile&&) = delete;
    ~TrustedFile();

    /// A path that leads to the file that was looked at: its own, unless somebody else can change a folder on the way. Then it is the path
    /// of the open file, which is valid while this object exists.
    const std::string& path() const noexcept { return stable; }

    /// Makes path() valid until the program ends. Needed for what the system's loader has loaded, since it takes two files of one path for
    /// the same.
    void keepPath() noexcept;

private:
    explicit TrustedFile (int f) noexcept : file (f) {}

    int file = -1;
    bool is_by_number = false;   // `stable` is the path of the open file
    std::string stable;
};

}   // namespace tactus
