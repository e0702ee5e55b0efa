// SPDX-License-Identifier: MIT
#pragma once

#include <framework/text/result.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace tactus
{

/// A file that is written completely or not at all. The error of all functions is output/unwritable.
///
/// Writing goes to a temporary file in the folder of the target; commit() renames it to the target. Without a commit, the
/// target stays unchanged. This protects against a program that stops halfway, but not against a power failure: nothing is
/// synced to the disk. Symbolic links and permissions are kept.
///
/// A target that exists and is not a regular file (/dev/null, a pipe) cannot be replaced and is written directly.
class AtomicFile
{
public:
    /// Opens the file. Fails immediately if the file cannot be written, so that no work is wasted.
    static Result<AtomicFile> create (const std::filesystem::path& target);

    AtomicFile (AtomicFile&& other) noexcept;
    AtomicFile& operator= (AtomicFile&& other) noexcept;
    ~AtomicFile();

    std::ostream& stream() noexcept { return out; }
    const std::filesystem::path& path() const noexcept { return target; }

    /// Closes the file and moves it to the target. This must be the last call.
    Result<> commit();

    /// The error after a write to stream() failed. Call it immediately, while errno is still set.
    Message writeError() const;

private:
    explicit AtomicFile (std::filesystem::path t) : target (std::move (t)) {}
    Result<> open();
    Message unwritable (const std::string& reason) const;
    void discard() noexcept;

    std::filesystem::path target;
    std::filesystem::path temporary;   // path of the temporary file; empty if there is none to remove
    std::ofstream out;
};

}   // namespace tactus
