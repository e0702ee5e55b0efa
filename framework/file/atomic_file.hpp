// SPDX-License-Identifier: MIT
#pragma once

#include "file_lock.hpp"

#include <tactus/text/result.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace tactus
{

/// Opens a file for writing in place, without a temporary file. Null, with errno, if that fails. A program may replace how pipes and devices are opened,
/// because opening and writing them may wait forever; regular files are always opened as files. [any thread]
std::unique_ptr<std::ostream> openDirectly (const std::filesystem::path&);

/// Opens a pipe or a device, like openDirectly. [any thread]
using OpenPipe = std::unique_ptr<std::ostream> (*) (const std::filesystem::path&);
void openPipesBy (OpenPipe) noexcept;

/// Closes the stream of a file. False, with errno, if not everything was written. [any thread]
bool closed (std::unique_ptr<std::ostream>&);

/// The fate of an unfinished file if the process is killed.
enum class IfKilled
{
    removed,   ///< the next process that writes into this folder removes it
    kept       ///< it is next to the target, as NAME.partial.csv for NAME.csv (or NAME.partial-2.csv and so on if that exists)
};

/// A file that is written completely or not at all. The error of all functions is output/unwritable.
///
/// Writing goes to a temporary file in the folder of the target; commit() renames it to the target. Without a commit, the
/// target stays unchanged. This protects against a program that stops halfway, but not against a power failure: nothing is
/// synced to the disk. Symbolic links and permissions are kept.
///
/// A temporary file is locked while it is written, so files of killed processes can be told from files of running ones.
///
/// A target that exists and is not a regular file (/dev/null, a pipe) cannot be replaced and is written directly, through openDirectly().
class AtomicFile
{
public:
    /// Opens the file. Fails immediately if the file cannot be written, so that no work is wasted.
    static Result<AtomicFile> create (const std::filesystem::path& target, IfKilled = IfKilled::removed);

    AtomicFile (AtomicFile&& other) noexcept;
    AtomicFile& operator= (AtomicFile&& other) noexcept;
    ~AtomicFile();

    std::ostream& stream() noexcept { return *out; }
    const std::filesystem::path& path() const noexcept { return target; }

    /// Closes the file and moves it to the target. This must be the last call.
    Result<> commit();

    /// The error after a write to stream() failed. Call it immediately, while errno is still set.
    Message writeError() const;

private:
    explicit AtomicFile (std::filesystem::path t) : target (std::move (t)) {}
    Result<> open (IfKilled);
    Result<> openTemporary (IfKilled);
    bool lockTemporary();
    Message unwritable (const std::string& reason) const;
    void discard() noexcept;

    std::filesystem::path target;
    std::filesystem::path temporary;   // path of the temporary file; empty if there is none to remove
    std::unique_ptr<std::ostream> out;
    std::optional<FileLock> lock;   // of the temporary file
};

/// The unfinished files of this target that killed processes have left (IfKilled::kept).
std::vector<std::filesystem::path> leftUnfinished (const std::filesystem::path& target);

}   // namespace tactus
