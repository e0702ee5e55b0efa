// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace tactus::host
{

/// A file that appears whole or not at all.
///
/// What is written goes to a temporary file in the folder of the target; commit() renames it into place. Destroyed
/// without a commit, it leaves the target as it was. Meant against a program that stops half way, not against a
/// power cut: nothing is synced to the disk.
///
/// A target that exists and is no regular file (/dev/null, a pipe) cannot be renamed onto and is written directly.
class AtomicFile
{
public:
    /// Fails with "output/unwritable" before anything is computed for nothing.
    [[nodiscard]] static tl::expected<AtomicFile, Error> create (std::filesystem::path target);

    AtomicFile (AtomicFile&& other) noexcept;
    AtomicFile& operator= (AtomicFile&& other) noexcept;
    ~AtomicFile();

    std::ostream& stream() noexcept { return out; }

    /// Closes the file and puts it in place; says so if any write before has failed. Call it once, last.
    [[nodiscard]] tl::expected<void, Error> commit();

    /// The error to return when a write to stream() failed; call it at once, while errno still knows the reason.
    [[nodiscard]] Error writeFailed() const;

private:
    AtomicFile() = default;
    void discard() noexcept;

    std::filesystem::path target;
    std::filesystem::path temporary;   // empty: nothing to remove
    std::ofstream out;
};

}   // namespace tactus::host
