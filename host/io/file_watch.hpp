// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/platform/folder_watch.hpp>

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
    /// Where the system tells which files are written, a look at files that rest costs one call into the system, and a file that is
    /// still open is not reported, unless nobody writes to it for `most_quiet` looks. As often, the files are compared all the same, for
    /// folders that another computer shares.
    bool look();

    /// True if the system tells which files are written, so that a look at files that rest costs little.
    bool isTold() const noexcept { return folders.isTold(); }

    static constexpr int most_quiet = 20;

private:
    struct Watched
    {
        std::filesystem::path file;
        std::filesystem::file_time_type written {};
        std::uintmax_t size = 0;
        std::optional<std::string> latest;           ///< content at the last look; empty if it could not be read
        std::optional<std::string> known, pending;   ///< known: last reported; pending: seen once but not reported yet
    };

    static bool readAgain (Watched&);
    bool compare (bool is_writing);
    void watchFolders();

    std::vector<Watched> all;
    FolderWatch folders;
    bool is_unsettled = false;   // a change was seen, but not reported
    int quiet = 0;               // looks since the last news, or since the files were compared without news
};

}   // namespace tactus::host
