// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace tactus
{

/// A file that appears whole or not at all.
///
/// What is written goes to a temporary file in the folder of the target; commit() renames it into place. Destroyed
/// without a commit, it leaves the target as it was. Meant against a program that stops half way, not against a
/// power cut: nothing is synced to the disk. Links stay links, and permissions stay.
///
/// A target that exists and is no regular file (/dev/null, a pipe) cannot be renamed onto and is written directly.
class AtomicFile
{
public:
    /// Opens the file; refused() says if that did not work, before anything is computed for nothing.
    explicit AtomicFile (std::filesystem::path target);

    AtomicFile (AtomicFile&& other) noexcept;
    AtomicFile& operator= (AtomicFile&& other) noexcept;
    ~AtomicFile();

    /// Why the file cannot be written, or nothing.
    const std::optional<std::string>& refused() const noexcept { return refusal; }

    std::ostream& stream() noexcept { return out; }
    const std::filesystem::path& path() const noexcept { return target; }

    /// Closes the file and puts it in place, or says why it could not. Call it once, last.
    [[nodiscard]] std::optional<std::string> commit();

    /// The reason when a write to stream() failed; ask at once, while errno still knows it.
    static std::string lastReason();

private:
    void open();
    void discard() noexcept;

    std::filesystem::path target;
    std::filesystem::path temporary;   // empty: nothing to remove
    std::ofstream out;
    std::optional<std::string> refusal;
};

}   // namespace tactus
