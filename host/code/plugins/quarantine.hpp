// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/file_lock.hpp>
#include <tactus/text/message.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace tactus::host
{

/// Remembers which plugins crashed the program while they were being loaded. A mark is written before loading and removed
/// afterwards, so a mark that no program has locked was left by a crash. A plugin that has changed since then is tried again. [main
/// thread]
class Quarantine
{
public:
    /// The marks are files in this folder. Without a folder, nothing is remembered.
    explicit Quarantine (std::filesystem::path folder_) : folder (std::move (folder_)) {}

    /// True if the program crashed or was killed the last time it loaded this file, and the file has not changed since.
    bool holds (const std::filesystem::path& file) const;

    /// The path of the mark of a plugin. After the mark is removed, the plugin is loaded again.
    std::filesystem::path markOf (const std::filesystem::path& file) const;

    /// The error about a file that it holds. Id: plugin/quarantined.
    Message refusal (const std::filesystem::path& file) const;

    /// Marks a file until this object is destroyed.
    class LoadingMark
    {
    public:
        LoadingMark (const Quarantine&, const std::filesystem::path& file);
        LoadingMark (const LoadingMark&) = delete;
        LoadingMark& operator= (const LoadingMark&) = delete;
        ~LoadingMark();

    private:
        std::filesystem::path mark;
        std::optional<FileLock> lock;   // while a program holds it, the mark does not mean a crash
    };

private:
    std::filesystem::path folder;
};

}   // namespace tactus::host
