// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace tactus::host
{

/// A folder that is written completely or not at all: a new one, or one in place of another that this program wrote earlier.
///
/// It is made next to the target, in a folder that only this user can enter, and takes the place of the target in one step, by a rename. No
/// link is followed within either folder, so nothing outside of them is written or removed, whatever other users put there. A program that
/// is killed leaves the old folder or the new one, and next to it, in .tactus-XXXXXX, what it had not finished writing or removing. Only file
/// systems that cannot exchange two folders need two renames: between them there is no target, and .tactus-XXXXXX has both folders. Not
/// on Windows. [one thread]
class AtomicFolder
{
public:
    /// Checks what is in the target. It may be nothing, or an earlier folder with a file of this name that lists what was written.
    /// Errors: output/exists (something else is there, or it belongs to another user, or this program works in it).
    static Result<> check (const std::filesystem::path& target, const std::string& list = {});

    /// Begins. Errors: those of check, output/unwritable.
    static Result<AtomicFolder> create (const std::filesystem::path& target, const std::string& list = {});

    AtomicFolder (AtomicFolder&&) noexcept;
    AtomicFolder& operator= (AtomicFolder&&) = delete;
    ~AtomicFolder();   ///< without a commit, removes what was written

    /// Writes a file, and the folders that its name begins with. Errors: output/unwritable.
    Result<> write (const std::string& name, std::string_view text);

    /// Keeps what is in the old folder besides the files of its list: links are kept as links. Call it after the last write.
    /// Errors: output/exists (a file that is not in the list has the name of a written one), output/unwritable.
    Result<> keepOthers();

    /// Puts the folder in its place. This must be the last call. Errors: output/unwritable.
    Result<> commit();

private:
    class Work;
    explicit AtomicFolder (std::unique_ptr<Work>) noexcept;

    std::unique_ptr<Work> work;
};

}   // namespace tactus::host
