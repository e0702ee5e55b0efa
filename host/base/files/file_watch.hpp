// SPDX-License-Identifier: MIT
#pragma once

#include <host/base/platform/folder_watch.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// Notices edits of files. Only the content counts, so an editor may write in place or replace the file by renaming another
/// one, and saving an unchanged file is not an edit. Waits for a file that is missing or empty. [main thread]
class FileWatch
{
public:
    explicit FileWatch (std::vector<std::filesystem::path> files) { watch (std::move (files)); }

    /// From now on, watches these files. Files that were already watched are still compared with their known content.
    void watch (std::vector<std::filesystem::path>);

    /// True if files have changed since the last time it returned true, and have not changed since the previous look: a
    /// file that is still being written keeps changing. Call this a few times a second.
    ///
    /// Where the system reports which files are written, a look at unchanged files costs one system call. A file that a program still has
    /// open is not reported until `most_quiet` looks have passed without a write to it. All files are compared after `most_quiet` looks
    /// in any case, because the system does not report changes that another computer makes in a shared folder.
    bool poll();

    /// True if the system reports which files are written, so that a look at unchanged files costs little.
    bool isTold() const noexcept { return folders.isTold(); }

    static constexpr int most_quiet = 20;

private:
    struct WatchedFile
    {
        std::filesystem::path file;
        std::filesystem::file_time_type written {};
        std::uintmax_t size = 0;
        std::optional<std::string> latest;           ///< content at the last look; empty if it could not be read
        std::optional<std::string> known, pending;   ///< known: last reported; pending: seen once but not reported yet
    };

    static bool readAgain (WatchedFile&);
    bool compare (bool is_writing);
    void watchFolders();

    std::vector<WatchedFile> all;
    FolderWatch folders;
    bool is_unsettled = false;   // a change was seen, but not reported
    int quiet = 0;               // looks since the last event, or since the files were last compared
};

}   // namespace tactus::host
